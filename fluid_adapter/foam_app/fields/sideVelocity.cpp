// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/fields/sideVelocity.hpp"

#include <cmath>

#include "coupler/protocol/failure.hpp"
#include "fluid_adapter/domain/fluid_domain.hpp"
#include "fluid_adapter/fluid_window/box_of_grid.hpp"

namespace turbidite {
namespace {

/// 0 to 5 for a face that looks left, right, down, up, to the front, to the back out of the box.
int side_of(const Foam::vector& outward) {
    int axis = 0;
    for (const int other : {1, 2})
        if (std::abs(outward[other]) > std::abs(outward[axis])) axis = other;
    return 2 * axis + (outward[axis] < 0.0 ? 0 : 1);
}

/// Shares of the profile on the faces of a patch along the side; in space it is uniform.
std::vector<double> shares_of(const Foam::fvPatch& patch, const BoxSide& side,
                              const SideMotion& motion, const FluidFields& fields) {
    if (fields.in_space) return std::vector<double>(patch.size(), 1.0);
    const int axis = 1 - side.axis;
    const Foam::boundBox& box = fields.mesh.bounds();
    const Foam::scalar origin = box.min()[axis], length = box.span()[axis];
    std::vector<double> shares;
    forAll(patch, face) {
        // Half of the face along the side; in the plane |S| is length times thickness.
        const Foam::scalar half = 0.5 * patch.magSf()[face] / fields.thickness;
        const Foam::scalar at = patch.Cf()[face][axis] - origin;
        // The mean of the profile over the face: what all faces let in is exact on any mesh.
        shares.push_back(motion.share((at - half) / length, (at + half) / length));
    }
    return shares;
}

}  // namespace

SideVelocity::SideVelocity(const std::array<SideMotion, box_sides.size()>& motions,
                           FluidFields& fields)
    : motions_(motions), fields_(fields) {
    for (std::size_t side = 0; side < box_sides.size(); ++side) {
        const BoxSide& at = box_sides[side];
        if (!motions_[side].motion) continue;
        const Foam::label patch = fields.mesh.boundary().findPatchID(at.name);
        if (patch < 0 || !fields.U.boundaryField()[patch].fixesValue())
            throw Failure(ExitCode::bad_input,
                          std::string(at.key) +
                              "_motion prescribes a velocity, but 0/U of the fluid case holds no "
                              "value on patch " +
                              at.name + "; use type fixedValue there");
        patches_.push_back({patch, side, &motions_[side],
                            shares_of(fields.mesh.boundary()[patch], at, motions_[side], fields)});
    }
}

MovedSides SideVelocity::set(double time, double step) {
    MovedSides sides;
    for (const MovedPatch& moved : patches_) {
        const Vec3 velocity = moved.motion->velocity(time, step);
        sides.add(moved.side, velocity);
        const Foam::vector v(velocity[0], velocity[1], velocity[2]);
        Foam::fvPatchVectorField& side = fields_.U.boundaryFieldRef()[moved.patch];
        Foam::vectorField values(side.size());
        forAll(values, face) values[face] = moved.shares[face] * v;
        side == values;  // sets the value itself
    }
    return sides;
}

VelocityOnSides held_on_sides(const FluidFields& fields, const BoxCells& box) {
    const std::array<int, 2> length = {box.cells[1], box.cells[0]};
    // One after the other: left and right by row, bottom and top by column
    const int per_component = 2 * (length[0] + length[1]);
    const auto first = [&](int side) {
        return side < 2 ? side * length[0] : 2 * length[0] + (side - 2) * length[1];
    };
    // Zero but for the faces of this rank: the sum puts whole sides together on every rank.
    std::vector<double> values(2 * per_component, 0.0);
    for (const auto& condition : fields.U.boundaryField()) {
        // Elsewhere the values are to be zero (side_values.hpp).
        if (condition.coupled() || !condition.fixesValue()) continue;
        const Foam::labelUList& cells = condition.patch().faceCells();
        forAll(cells, face) {
            const int side = side_of(condition.patch().Sf()[face]);
            const int place = box.place[cells[face]];
            const int at = first(side) + (side < 2 ? box.row(place) : box.column(place));
            for (int axis = 0; axis < 2; ++axis)
                values[axis * per_component + at] = condition[face][axis];
        }
    }
    box.ranks.sum(values.data(), static_cast<int>(values.size()));
    VelocityOnSides sides;
    for (int axis = 0; axis < 2; ++axis)
        for (int side = 0; side < 4; ++side) {
            const auto from = values.begin() + axis * per_component + first(side);
            sides[axis][side].assign(from, from + length[side / 2]);
        }
    return sides;
}

VelocityOnSides held_on_sides(const FluidFields& fields, const CellGrid& grid) {
    VelocityOnSides sides = sides_at_rest(grid);
    const int nx = grid.counts[0], nz = grid.counts[2];
    for (const auto& condition : fields.U.boundaryField()) {
        if (condition.coupled() || !condition.fixesValue()) continue;
        const Foam::labelUList& cells = condition.patch().faceCells();
        forAll(cells, face) {
            const Foam::point& centre = fields.mesh.cellCentres()[cells[face]];
            const int i = grid.layer(0, centre.x()), j = grid.layer(1, centre.y()),
                      k = grid.layer(2, centre.z());
            const int side = side_of(condition.patch().Sf()[face]);
            const int place = side < 2 ? k + nz * j : side < 4 ? i + nx * k : i + nx * j;
            for (int axis = 0; axis < 3; ++axis) sides[axis][side][place] = condition[face][axis];
        }
    }
    for (SideValues& of : sides)
        for (std::vector<double>& values : of)
            fields.ranks.sum(values.data(), static_cast<int>(values.size()));
    return sides;
}

}  // namespace turbidite
