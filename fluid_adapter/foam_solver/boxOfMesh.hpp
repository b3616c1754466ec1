// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is kept with a mesh between solves: where its cells lie in the box and, for each field that
// is solved for, the inverse of the operator it met last. OpenFOAM deletes it when the mesh changes
// its topology.
#pragma once

#include <MeshObject.H>
#include <lduMatrix.H>

#include <map>
#include <string>

#include "fluid_adapter/foam_solver/boxInverse.hpp"

namespace turbidite {

class BoxOfMesh final
    : public Foam::MeshObject<Foam::lduMesh, Foam::TopologicalMeshObject, BoxOfMesh> {
 public:
    using word = Foam::word;  // TypeName means it
    TypeName("turbiditeBoxOfMesh");

    /// Throws DoesNotFit.
    explicit BoxOfMesh(const Foam::lduMesh& mesh);

    /// That of the matrix's mesh, made at the first call, which all ranks make. Throws DoesNotFit.
    static const BoxOfMesh& of(const Foam::lduMatrix& matrix);

    const BoxCells& cells() const { return cells_; }
    BoxInverse& inverse(const std::string& field) const;

 private:
    BoxCells cells_;
    mutable CellRows rows_;
    mutable std::map<std::string, BoxInverse> inverses_;
};

}  // namespace turbidite
