// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/uniformBox.hpp"

#include <cyclicPolyPatch.H>

#include <cmath>
#include <string>

#include "fluid_adapter/foam_case/fluid_domain.hpp"

namespace turbidite {
namespace {

/// Places may be off by this share of a cell. Differences of the solve and of the mesh then differ
/// by as much, and so does what is left of the divergence.
constexpr double placement_tolerance = 1e-6;

/// Cells of the first row: those level with the first one.
int first_row(const Foam::fvMesh& mesh) {
    const Foam::vectorField& centres = mesh.cellCentres();
    const double level =
        placement_tolerance * std::sqrt(std::abs(mesh.V()[0] / mesh.bounds().span().z()));
    int count = 0;
    while (count < mesh.nCells() && std::abs(centres[count].y() - centres[0].y()) < level) ++count;
    return count;
}

void check_layer(const Foam::fvMesh& mesh) {
    if (Foam::Pstream::parRun()) throw NotSeparable("the fluid runs on several ranks");
    if (mesh.nSolutionD() != 2 || mesh.solutionD().z() != -1)
        throw NotSeparable("the mesh is not one layer of cells between empty patches along z");
}

void check_centres(const Foam::fvMesh& mesh, const UniformBox& box) {
    const Foam::point corner = mesh.bounds().min();
    forAll(mesh.cellCentres(), c) {
        const std::array<int, 2> index = {c % box.cells[0], c / box.cells[0]};
        for (int axis = 0; axis < 2; ++axis) {
            const double h = box.spacing[axis];
            const double expected = corner[axis] + (index[axis] + 0.5) * h;
            if (std::abs(mesh.cellCentres()[c][axis] - expected) > placement_tolerance * h)
                throw NotSeparable("cell " + std::to_string(c) +
                                   " is not where a uniform box numbered row by row has it");
        }
    }
}

/// The side that all faces of a patch lie on, or -1.
int side_of(const Foam::fvPatch& patch, const UniformBox& box) {
    const Foam::boundBox& bounds = patch.boundaryMesh().mesh().bounds();
    for (int side = 0; side < 4; ++side) {
        const int axis = side / 2;
        const double place = side % 2 == 0 ? bounds.min()[axis] : bounds.max()[axis];
        bool all = patch.size() == box.cells[1 - axis];
        for (const Foam::vector& centre : patch.Cf())
            all = all && std::abs(centre[axis] - place) < placement_tolerance * box.spacing[axis];
        if (all) return side;
    }
    return -1;
}

void find_patches(const Foam::fvMesh& mesh, UniformBox& box) {
    box.patches.fill(-1);
    forAll(mesh.boundary(), patch) {
        const Foam::fvPatch& boundary = mesh.boundary()[patch];
        if (boundary.size() == 0 || boundary.type() == "empty") continue;
        const int side = side_of(boundary, box);
        if (side < 0) throw NotSeparable("patch " + boundary.name() + " is not one whole side");
        box.patches[side] = patch;
    }
    for (int side = 0; side < 4; ++side)
        if (box.patches[side] < 0)
            throw NotSeparable(std::string("no patch is the ") + side_names[side] + " side");
}

bool faces_across(const Foam::fvPatch& patch, Foam::label across) {
    const auto* cyclic = dynamic_cast<const Foam::cyclicPolyPatch*>(&patch.patch());
    return cyclic && cyclic->neighbPatchID() == across;
}

template <class Type>
End end_of(const Foam::fvPatchField<Type>& condition, Foam::label across) {
    const Foam::word& kind = condition.type();
    if (kind == "zeroGradient") return End::neumann;
    if (kind == "noSlip") return End::dirichlet;
    if (kind == "cyclic" && faces_across(condition.patch(), across)) return End::periodic;
    if (kind == "fixedValue") {
        if (Foam::max(Foam::mag(condition)()) == 0.0) return End::dirichlet;
        throw NotSeparable("the value fixed on patch " + condition.patch().name() + " is not zero");
    }
    throw NotSeparable("condition " + kind + " on patch " + condition.patch().name());
}

}  // namespace

UniformBox uniform_box(const Foam::fvMesh& mesh) {
    check_layer(mesh);
    UniformBox box;
    box.cells[0] = first_row(mesh);
    box.cells[1] = mesh.nCells() / box.cells[0];
    for (int axis = 0; axis < 2; ++axis)
        box.spacing[axis] = mesh.bounds().span()[axis] / box.cells[axis];
    if (box.cells[0] * box.cells[1] != mesh.nCells())
        throw NotSeparable("the mesh's rows differ in length");
    check_centres(mesh, box);
    find_patches(mesh, box);
    return box;
}

template <class Type>
PlaneOperator plane_operator(
    const Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh>& field) {
    const UniformBox box = uniform_box(field.mesh());
    std::array<AxisOperator, 2> axes;
    for (int axis = 0; axis < 2; ++axis) {
        const Foam::label lower = box.patches[2 * axis], upper = box.patches[2 * axis + 1];
        axes[axis] = {box.cells[axis], box.spacing[axis],
                      end_of(field.boundaryField()[lower], upper),
                      end_of(field.boundaryField()[upper], lower)};
    }
    return {axes[0], axes[1]};
}

template PlaneOperator plane_operator(const Foam::volScalarField&);
template PlaneOperator plane_operator(const Foam::volVectorField&);

}  // namespace turbidite
