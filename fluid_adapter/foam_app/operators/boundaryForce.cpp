// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/operators/boundaryForce.hpp"

namespace turbidite {
namespace {

/// Sums `per_face(patch)`, a tmp<vectorField>, over the true boundary. Faces shared by ranks or
/// joined by a cyclic side have two sides that cancel.
template <class PerFace>
BoundaryForce over_faces(const FluidFields& fields, PerFace per_face) {
    Foam::vector sum = Foam::Zero;
    forAll(fields.mesh.boundary(), patch) {
        const Foam::fvPatch& side = fields.mesh.boundary()[patch];
        if (!side.coupled() && side.size() > 0) sum += Foam::sum(per_face(patch)());
    }
    fields.ranks.sum(sum.v_, Foam::vector::nComponents);
    // Per unit length: the mesh has a thickness, and these steps are of the plane alone.
    return {sum.x() / fields.thickness, sum.y() / fields.thickness};
}

}  // namespace

BoundaryForce pressure_force(const FluidFields& fields) {
    return over_faces(fields, [&](Foam::label patch) {
        // S points outwards, so what enters has the minus.
        return -fields.p.boundaryField()[patch] * fields.mesh.Sf().boundaryField()[patch];
    });
}

BoundaryForce convective_force(const FluidFields& fields) {
    return over_faces(fields, [&](Foam::label patch) {
        return -fields.phi.boundaryField()[patch] * fields.U.boundaryField()[patch];
    });
}

BoundaryForce viscous_force(const FluidFields& fields) {
    return over_faces(fields, [&](Foam::label patch) {
        // nu |S| du/dn, the gradient along the outward normal
        return fields.nu * fields.mesh.magSf().boundaryField()[patch] *
               fields.U.boundaryField()[patch].snGrad();
    });
}

}  // namespace turbidite
