// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/coupled_step/rigid_grains.hpp"

#include <utility>

namespace turbidite {

RigidGrains::RigidGrains(SaddleOperator& system, ConstrainedFlow& flow, CellVelocity velocity,
                         const MultiplierSettings& settings)
    : system_(system),
      flow_(flow),
      velocity_(velocity),
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
    for (std::size_t c = 0; c < cells_; ++c) {
        change.x[c] = keep * change.x[c] + other.x[c];
        change.y[c] = keep * change.y[c] + other.y[c];
    }
    change.grains.scale(keep);
    change.grains.add(other.grains, 1.0);
}

void RigidGrains::add(const RigidChange& change, double share) {
    add_later(change, share);
    velocity();
}

void RigidGrains::add_later(const RigidChange& change, double share) {
    velocity();
    pending_ = {share, change.x.data(), change.y.data()};
    flow_.add(change.grains, share);
}

PendingChange RigidGrains::take_pending() {
    return std::exchange(pending_, {});
}

CellVelocity RigidGrains::velocity() {
    const PendingChange change = take_pending();
    for (std::size_t c = 0; change.share != 0.0 && c < cells_; ++c) {
        velocity_.x[c] += change.share * change.x[c];
        velocity_.y[c] += change.share * change.y[c];
    }
    return velocity_;
}

}  // namespace turbidite
