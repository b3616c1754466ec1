// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_solver/boxOfMesh.hpp"

namespace turbidite {

defineTypeNameAndDebug(BoxOfMesh, 0);

BoxOfMesh::BoxOfMesh(const Foam::lduMesh& mesh)
    : MeshObject(mesh), numbering_(number_box(mesh.lduAddr())) {}

const BoxOfMesh& BoxOfMesh::of(const Foam::lduMatrix& matrix) {
    if (Foam::Pstream::parRun()) throw DoesNotFit("FFT on several ranks is not there yet");
    if (!matrix.mesh().hasDb()) throw DoesNotFit("it belongs to a coarse level and not to a mesh");
    const Foam::objectRegistry& registry = matrix.mesh().thisDb();
    if (const auto* known = registry.findObject<BoxOfMesh>(typeName)) return *known;
    return store(new BoxOfMesh(matrix.mesh()));
}

}  // namespace turbidite
