// SPDX-License-Identifier: GPL-3.0-or-later
//
// Data kept with a mesh between solves: the places of its cells in the box and, for each field
// solved for, the inverse of its last operator. OpenFOAM deletes it when the topology of the mesh
// changes.
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
    using word = Foam::word;  // used by the macro TypeName
    TypeName("turbiditeBoxOfMesh");

    /// Throws DoesNotFit.
    explicit BoxOfMesh(const Foam::lduMesh& mesh);

    /// The box of the matrix's mesh, created at the first call, which all ranks must make. Throws
    /// DoesNotFit.
    static const BoxOfMesh& of(const Foam::lduMatrix& matrix);

    const BoxCells& cells() const { return cells_; }
    BoxInverse& inverse(const std::string& field) const;

 private:
    BoxCells cells_;
    mutable CellRows rows_;
    mutable std::map<std::string, BoxInverse> inverses_;
};

}  // namespace turbidite
