// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_solver/boxOfMesh.hpp"

namespace turbidite {

defineTypeNameAndDebug(BoxOfMesh, 0);

BoxOfMesh::BoxOfMesh(const Foam::lduMesh& mesh)
    : MeshObject(mesh),
      cells_(number_cells(mesh, openfoam_ranks())),
      rows_(cells_.ranks, cells_.cells[0], cells_.cells[1], cells_.place) {}

const BoxOfMesh& BoxOfMesh::of(const Foam::lduMatrix& matrix) {
    if (!matrix.mesh().hasDb()) throw DoesNotFit("it belongs to a coarse level and not to a mesh");
    const Foam::objectRegistry& registry = matrix.mesh().thisDb();
    // Kept with the mesh: numbering needs the faces of all ranks, and is done once.
    if (const auto* known = registry.findObject<BoxOfMesh>(typeName)) return *known;
    return store(new BoxOfMesh(matrix.mesh()));
}

BoxInverse& BoxOfMesh::inverse(const std::string& field) const {
    return inverses_.try_emplace(field, cells_, rows_).first->second;
}

}  // namespace turbidite
