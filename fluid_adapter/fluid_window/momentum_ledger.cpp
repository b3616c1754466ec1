// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/fluid_window/momentum_ledger.hpp"

#include <algorithm>

#include "coupler/rigid/impulse.hpp"

namespace turbidite {

void MomentumLedger::open(double dt) {
    dt_ = dt;
    // P^n is what the last window has closed with, unless u was changed from outside.
    const FluidMomentum momentum = current_ ? *current_ : field_.momentum();
    before_ = momentum.sum;
    at_rest_ = momentum.magnitudes == 0.0;
    current_.reset();
    impulses_ = {};
    largest_ = 0.0;
}

void MomentumLedger::add(const BoundaryForce& force, double share) {
    const Vec3 impulse = share * density_ * dt_ * Vec3{force[0], force[1], force[2]};
    impulses_ = impulses_ + impulse;
    largest_ = std::max(largest_, norm(impulse));
}

void MomentumLedger::add(const std::vector<BoundaryForce>& forces) {
    for (const BoundaryForce& force : forces) add(force, 1.0 / static_cast<double>(forces.size()));
}

bool MomentumLedger::finite() const {
    return current_ && is_finite(current_->sum);
}

double MomentumLedger::close(const Vec3& to_grains) {
    const FluidMomentum now = field_.momentum();
    current_ = now;
    const Vec3 change = now.sum - before_;
    // P^{n+1} - P^n + sum dt lambda - impulses
    const double defect = norm(change + to_grains - impulses_);
    // The momenta of all cells without their signs: impulses may cancel, as in a shear flow.
    const double scale =
        std::max({largest_, norm(change), norm(to_grains), beyond_rounding * now.magnitudes});
    return scale > 0.0 ? defect / scale : 0.0;
}

}  // namespace turbidite
