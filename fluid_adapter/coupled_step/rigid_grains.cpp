// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/coupled_step/rigid_grains.hpp"

#include <utility>

namespace turbidite {

RigidGrains::RigidGrains(SaddleOperator& system, ConstrainedFlow& flow, CellVelocity velocity,
                         const MultiplierSettings& settings)
    : system_(system),
      flow_(flow),
      velocity_{velocity.x, velocity.y},
      settings_(settings),
      cells_(system.field().owned_cells()) {}

void RigidGrains::make_rigid(RigidChange& change, double reduction) {
    MultiplierSettings settings = settings_;
    settings.tolerance = 1.0;  // the slip of a change is judged by its own size
    settings.reduction = reduction;
    change.grains.begin(system_, change.velocity());
    note(uzawa_cg(change.grains, settings, work_));
    change.grains.impose();
}

MultiplierResult RigidGrains::settle() {
    velocity();
    const MultiplierResult result = uzawa_cg(flow_, settings_, work_);
    note(result);
    flow_.impose();
    return result;
}

void RigidGrains::note(const MultiplierResult& result) {
    iterations_ += result.iterations;
    converged_ = converged_ && result.converged;
}

void RigidGrains::combine(RigidChange& change, double keep, const RigidChange& other) const {
    for (int axis = 0; axis < change.u.size(); ++axis)
        for (std::size_t c = 0; c < cells_; ++c)
            change.u[axis][c] = keep * change.u[axis][c] + other.u[axis][c];
    change.grains.scale(keep);
    change.grains.add(other.grains, 1.0);
}

void RigidGrains::add(const RigidChange& change, double share) {
    add_later(change, share);
    velocity();
}

void RigidGrains::add_later(const RigidChange& change, double share) {
    velocity();
    pending_ = {share, Components<const double*>(change.u.size())};
    for (int axis = 0; axis < change.u.size(); ++axis)
        pending_.change[axis] = change.u[axis].data();
    flow_.add(change.grains, share);
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
