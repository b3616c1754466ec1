// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/uniformBox.hpp"

#include <cyclicPolyPatch.H>
#include <processorCyclicPolyPatch.H>
#include <surfaceFields.H>

#include <cmath>
#include <string>

#include "fluid_adapter/foam_case/fluid_domain.hpp"

namespace turbidite {
namespace {

/// Places may be off by this share of a cell. Differences of the solve and of the mesh then differ
/// by as much, and so does what is left of the divergence.
constexpr double placement_tolerance = 1e-6;

/// Throws on every rank unless it is right on all of them.
void demand(bool right, const std::string& fault) {
    if (!Foam::returnReduce(right, Foam::andOp<bool>())) throw NotSeparable(fault);
}

void check_layer(const Foam::fvMesh& mesh) {
    if (mesh.nSolutionD() != 2 || mesh.solutionD().z() != -1)
        throw NotSeparable("the mesh is not one layer of cells between empty patches along z");
}

/// Edges of the first cell; of the largest among the ranks' first cells.
Foam::vector first_cell(const Foam::fvMesh& mesh) {
    Foam::vector edges = Foam::Zero;
    if (mesh.nCells() > 0) {
        const Foam::pointField corners = mesh.cells()[0].points(mesh.faces(), mesh.points());
        edges = Foam::boundBox(corners, false).span();
    }
    return Foam::returnReduce(edges, Foam::maxOp<Foam::vector>());
}

/// Equal cells of this size fill the box.
void count_cells(const Foam::fvMesh& mesh, UniformBox& box) {
    const Foam::vector edges = first_cell(mesh), length = mesh.bounds().span();
    double all = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
        box.cells[axis] = static_cast<int>(std::lround(length[axis] / edges[axis]));
        box.spacing[axis] = length[axis] / box.cells[axis];
        all *= box.cells[axis];
    }
    demand(all == Foam::returnReduce(mesh.nCells(), Foam::sumOp<Foam::label>()),
           "the mesh is not rows and columns of equal cells");
    demand(box.cells[0] >= 3 && box.cells[1] >= 3, "the mesh has " + std::to_string(box.cells[0]) +
                                                       " x " + std::to_string(box.cells[1]) +
                                                       " cells; 3 x 3 is the least");
}

void number_cells(const Foam::fvMesh& mesh, UniformBox& box) {
    const Foam::point corner = mesh.bounds().min();
    bool uniform = true;
    for (const Foam::point& centre : mesh.cellCentres()) {
        int index[2];
        for (int axis = 0; axis < 2; ++axis) {
            const double place = (centre[axis] - corner[axis]) / box.spacing[axis] - 0.5;
            index[axis] = static_cast<int>(std::lround(place));
            uniform = uniform && std::abs(place - index[axis]) <= placement_tolerance;
        }
        box.numbers.push_back(index[0] + box.cells[0] * index[1]);
    }
    demand(uniform, "a cell is not where a uniform box of " + std::to_string(box.cells[0]) + " x " +
                        std::to_string(box.cells[1]) + " cells has it");
}

/// This rank's faces of a patch: what decomposePar cut out of a cyclic one included.
std::vector<Foam::point> faces_of(const Foam::fvMesh& mesh, Foam::label patch) {
    std::vector<Foam::point> centres(mesh.Cf().boundaryField()[patch].begin(),
                                     mesh.Cf().boundaryField()[patch].end());
    for (const Foam::fvPatch& other : mesh.boundary()) {
        const auto* cut = dynamic_cast<const Foam::processorCyclicPolyPatch*>(&other.patch());
        if (cut && cut->referPatchID() == patch)
            centres.insert(centres.end(), other.Cf().begin(), other.Cf().end());
    }
    return centres;
}

/// The side that all faces of a patch lie on and fill, -1 if none.
int side_of(const Foam::fvMesh& mesh, Foam::label patch, const UniformBox& box) {
    const std::vector<Foam::point> faces = faces_of(mesh, patch);
    const Foam::label count =
        Foam::returnReduce(static_cast<Foam::label>(faces.size()), Foam::sumOp<Foam::label>());
    for (int side = 0; side < 4; ++side) {
        const int axis = side / 2;
        const double place = side % 2 == 0 ? mesh.bounds().min()[axis] : mesh.bounds().max()[axis];
        bool all = count == box.cells[1 - axis];
        for (const Foam::point& centre : faces)
            all = all && std::abs(centre[axis] - place) < placement_tolerance * box.spacing[axis];
        if (Foam::returnReduce(all, Foam::andOp<bool>())) return side;
    }
    return -1;
}

void find_patches(const Foam::fvMesh& mesh, UniformBox& box) {
    box.patches.fill(-1);
    for (Foam::label patch = 0; patch < mesh.boundaryMesh().nNonProcessor(); ++patch) {
        const Foam::fvPatch& boundary = mesh.boundary()[patch];
        const Foam::label faces = Foam::returnReduce(
            static_cast<Foam::label>(faces_of(mesh, patch).size()), Foam::sumOp<Foam::label>());
        if (faces == 0 || boundary.type() == "empty") continue;
        const int side = side_of(mesh, patch, box);
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
        if (Foam::gMax(Foam::mag(condition)()) <= 0.0) return End::dirichlet;
        throw NotSeparable("the value fixed on patch " + condition.patch().name() + " is not zero");
    }
    throw NotSeparable("condition " + kind + " on patch " + condition.patch().name());
}

}  // namespace

UniformBox uniform_box(const Foam::fvMesh& mesh) {
    check_layer(mesh);
    UniformBox box;
    count_cells(mesh, box);
    number_cells(mesh, box);
    find_patches(mesh, box);
    return box;
}

template <class Type>
PlaneOperator plane_operator(
    const Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh>& field,
    const UniformBox& box) {
    std::array<AxisOperator, 2> axes;
    for (int axis = 0; axis < 2; ++axis) {
        const Foam::label lower = box.patches[2 * axis], upper = box.patches[2 * axis + 1];
        axes[axis] = {box.cells[axis], box.spacing[axis],
                      end_of(field.boundaryField()[lower], upper),
                      end_of(field.boundaryField()[upper], lower)};
    }
    return {axes[0], axes[1]};
}

template PlaneOperator plane_operator(const Foam::volScalarField&, const UniformBox&);
template PlaneOperator plane_operator(const Foam::volVectorField&, const UniformBox&);

CellRows cell_rows(const RankGroup& ranks, const UniformBox& box) {
    return CellRows(ranks, box.cells[0], box.cells[1], box.numbers);
}

}  // namespace turbidite
