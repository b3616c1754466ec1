// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/momentumLedger.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite {

void MomentumLedger::open() {
    before_ = current_ ? *current_ : field_.momentum();
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
    current_ = field_.momentum();
    const Foam::vector change = *current_ - before_;
    const Foam::scalar defect = Foam::mag(change + to_grains - impulses_);
    const Foam::scalar scale = std::max({largest_, Foam::mag(change), Foam::mag(to_grains)});
    return scale > 0.0 ? defect / scale : 0.0;
}

}  // namespace turbidite
