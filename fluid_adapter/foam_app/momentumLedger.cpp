// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/momentumLedger.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite {

void MomentumLedger::open() {
    before_ = current_ ? *current_ : fields_.momentum();
    current_.reset();
    impulses_ = Foam::Zero;
    largest_ = 0.0;
}

/// Sums `per_face(patch)`, a tmp<vectorField> of impulse over rho_f, over the true boundary: faces
/// shared by ranks or joined by a cyclic side have two sides that cancel.
template <class PerFace>
void MomentumLedger::add_faces(PerFace per_face, double share) {
    Foam::vector sum = Foam::Zero;
    forAll(fields_.mesh.boundary(), patch) {
        const Foam::fvPatch& side = fields_.mesh.boundary()[patch];
        if (!side.coupled() && side.size() > 0) sum += Foam::sum(per_face(patch)());
    }
    fields_.ranks.sum(sum.v_, Foam::vector::nComponents);
    sum *= share * fields_.rho * fields_.time.deltaTValue() / fields_.thickness;
    add_impulse(sum);
}

void MomentumLedger::add(const std::array<double, 2>& force, double share) {
    const Foam::scalar density_and_time = share * fields_.rho * fields_.time.deltaTValue();
    add_impulse(density_and_time * Foam::vector(force[0], force[1], 0.0));
}

void MomentumLedger::add_impulse(const Foam::vector& impulse) {
    impulses_ += impulse;
    largest_ = std::max(largest_, Foam::mag(impulse));
}

void MomentumLedger::add_pressure() {
    add_faces([this](Foam::label patch) {
        return -fields_.p.boundaryField()[patch] * fields_.mesh.Sf().boundaryField()[patch];
    });
}

void MomentumLedger::add_convection(double share) {
    add_faces(
        [this](Foam::label patch) {
            return -fields_.phi.boundaryField()[patch] * fields_.U.boundaryField()[patch];
        },
        share);
}

void MomentumLedger::add_viscosity() {
    add_faces([this](Foam::label patch) {
        return fields_.nu * fields_.mesh.magSf().boundaryField()[patch] *
               fields_.U.boundaryField()[patch].snGrad();
    });
}

bool MomentumLedger::finite() const {
    return current_ && std::isfinite(current_->x()) && std::isfinite(current_->y());
}

double MomentumLedger::close(const Foam::vector& to_grains) {
    current_ = fields_.momentum();
    const Foam::vector change = *current_ - before_;
    const Foam::scalar defect = Foam::mag(change + to_grains - impulses_);
    const Foam::scalar scale = std::max({largest_, Foam::mag(change), Foam::mag(to_grains)});
    return scale > 0.0 ? defect / scale : 0.0;
}

}  // namespace turbidite
