// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/coupled_step/rigid_grains.hpp"

#include <utility>

namespace turbidite {

void RigidGrains::make_rigid(RigidChange& change, double reduction) {
    note(constraint_.make_rigid(change.u.pointers(), reduction, change.grains));
}

MultiplierResult RigidGrains::settle() {
    velocity();
    const MultiplierResult result = constraint_.settle();
    note(result);
    return result;
}

void RigidGrains::note(const MultiplierResult& result) {
    iterations_ += result.iterations;
    converged_ = converged_ && result.converged;
}

void RigidGrains::combine(RigidChange& change, double keep, const RigidChange& other) const {
    // W is linear: with W r known, W d of d = r + keep d needs no solve.
    for (int axis = 0; axis < change.u.size(); ++axis)
        for (std::size_t c = 0; c < cells_; ++c)
            change.u[axis][c] = keep * change.u[axis][c] + other.u[axis][c];
    for (std::size_t k = 0; k < change.grains.size(); ++k)
        change.grains[k] = keep * change.grains[k] + other.grains[k];
}

void RigidGrains::add(const RigidChange& change, double share) {
    add_later(change, share);
    velocity();
}

void RigidGrains::add_later(const RigidChange& change, double share) {
    // Only one change can be pending: an earlier one is made first.
    velocity();
    pending_ = {share, Components<const double*>(change.u.size())};
    for (int axis = 0; axis < change.u.size(); ++axis)
        pending_.change[axis] = change.u[axis].data();
    constraint_.add(change.grains, share);
}

PendingChange RigidGrains::take_pending() {
    return std::exchange(pending_, {});
}

VelocityPointers RigidGrains::velocity() {
    const PendingChange pending = take_pending();
    for (int axis = 0; pending.share != 0.0 && axis < velocity_.size(); ++axis)
        for (std::size_t c = 0; c < cells_; ++c)
            velocity_[axis][c] += pending.share * pending.change[axis][c];
    return velocity_;
}

}  // namespace turbidite
