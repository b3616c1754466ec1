// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/momentumLedger.hpp"

#include <algorithm>

namespace turbidite {

void MomentumLedger::open() {
    before_ = fields_.momentum();
    impulses_ = Foam::Zero;
    largest_ = 0.0;
}

/// Sums `per_face(patch)`, a tmp<vectorField> of impulse over rho_f, over the true boundary: faces
/// shared by ranks or joined by a cyclic side have two sides that cancel.
template <class PerFace>
void MomentumLedger::add(PerFace per_face) {
    Foam::vector sum = Foam::Zero;
    forAll(fields_.mesh.boundary(), patch) {
        const Foam::fvPatch& side = fields_.mesh.boundary()[patch];
        if (!side.coupled() && side.size() > 0) sum += Foam::sum(per_face(patch)());
    }
    fields_.ranks.sum(sum.v_, Foam::vector::nComponents);
    sum *= fields_.rho * fields_.time.deltaTValue() / fields_.thickness;
    impulses_ += sum;
    largest_ = std::max(largest_, Foam::mag(sum));
}

void MomentumLedger::add_pressure() {
    add([this](Foam::label patch) {
        return -fields_.p.boundaryField()[patch] * fields_.mesh.Sf().boundaryField()[patch];
    });
}

void MomentumLedger::add_convection() {
    add([this](Foam::label patch) {
        return -fields_.phi.boundaryField()[patch] * fields_.U.boundaryField()[patch];
    });
}

void MomentumLedger::add_viscosity() {
    add([this](Foam::label patch) {
        return fields_.nu * fields_.mesh.magSf().boundaryField()[patch] *
               fields_.U.boundaryField()[patch].snGrad();
    });
}

double MomentumLedger::close(const Foam::vector& to_grains) const {
    const Foam::vector change = fields_.momentum() - before_;
    const Foam::scalar defect = Foam::mag(change + to_grains - impulses_);
    const Foam::scalar scale = std::max({largest_, Foam::mag(change), Foam::mag(to_grains)});
    return scale > 0.0 ? defect / scale : 0.0;
}

}  // namespace turbidite
