// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/momentumLedger.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite {
namespace {

/// Of the momenta of all cells, their signs apart. Where all impulses cancel, as in a shear flow,
/// the terms are the rounding of that sum, some 1e-16 to 1e-14 of it, and say nothing.
constexpr Foam::scalar beyond_rounding = 1e-7;

}  // namespace

void MomentumLedger::open() {
    before_ = current_ ? *current_ : field_.momentum().sum;
    current_.reset();
    impulses_ = Foam::Zero;
    largest_ = 0.0;
}

void MomentumLedger::add(const BoundaryForce& force, double share) {
    const Foam::scalar density_and_time = share * fields_.rho * fields_.time.deltaTValue();
    const Foam::vector impulse = density_and_time * Foam::vector(force[0], force[1], 0.0);
    impulses_ += impulse;
    largest_ = std::max(largest_, Foam::mag(impulse));
}

void MomentumLedger::add(const std::vector<BoundaryForce>& forces) {
    for (const BoundaryForce& force : forces) add(force, 1.0 / static_cast<double>(forces.size()));
}

bool MomentumLedger::finite() const {
    return current_ && std::isfinite(current_->x()) && std::isfinite(current_->y());
}

double MomentumLedger::close(const Foam::vector& to_grains) {
    const FluidMomentum now = field_.momentum();
    current_ = now.sum;
    const Foam::vector change = now.sum - before_;
    const Foam::scalar defect = Foam::mag(change + to_grains - impulses_);
    const Foam::scalar scale = std::max(
        {largest_, Foam::mag(change), Foam::mag(to_grains), beyond_rounding * now.magnitudes});
    return scale > 0.0 ? defect / scale : 0.0;
}

}  // namespace turbidite
