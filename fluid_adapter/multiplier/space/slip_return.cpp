// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/space/slip_return.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace turbidite {
namespace {

/// v + omega x r
Eigen::Vector3d rigid_velocity(const Twist& motion, const Eigen::Vector3d& arm) {
    const Vec3 u = motion.at({arm.x(), arm.y(), arm.z()});
    return {u[0], u[1], u[2]};
}

}  // namespace

std::vector<Eigen::Vector3d> SlipReturn::play(const std::vector<ImmersedGrain>& grains,
                                              const VelocityPointers& u) {
    std::vector<Sums> sums(grains.size(), Sums::Zero());
    u_ = u;
    field_.import_layers(u, beside_);
    change_.clear();
    shell_.clear();
    for (const CrossedCell& cell : crossed_.find(grains))
        return_from(cell, grains[cell.grain], sums[cell.grain]);
    for (const std::size_t g : crossed_.crossing()) find_shell(g, grains[g], sums[g]);
    field_.sum_over_holders(sums.empty() ? nullptr : sums.front().data(), Sums::SizeAtCompileTime);
    // Only now: what was read is the velocity of before.
    for (const auto& [cell, by] : change_)
        for (int axis = 0; axis < 3; ++axis) u[axis][cell] += by[axis];
    std::vector<Eigen::Vector3d> shift(grains.size(), Eigen::Vector3d::Zero()), moments = shift;
    for (std::size_t g = 0; g < grains.size(); ++g) {
        const double mass = sums[g][6];
        if (mass > 0.0) shift[g] = -sums[g].head<3>() / mass;
        // of the cells, and of the shell: sum m r x shift
        moments[g] = sums[g].segment<3>(3) + sums[g].tail<3>().cross(shift[g]);
    }
    for (const ShellCell& of : shell_)
        for (int axis = 0; axis < 3; ++axis) u[axis][of.cell] += of.weight * shift[of.grain][axis];
    return moments;
}

void SlipReturn::return_from(const CrossedCell& cell, const ImmersedGrain& sphere, Sums& sums) {
    // Behind it only the cell itself changes.
    if (!cell.covered && !owns(cell.at)) return;
    find_outside(cell, sphere);
    if (outside_.empty()) return;
    const Eigen::Vector3d half = 0.5 * returned(cell, sphere);
    give(cell, half);
    if (!owns(cell.at)) return;
    const Eigen::Vector3d impulse = field_.cell_mass(cell.at.i, cell.at.j) * half;
    sums.head<3>() += impulse;
    sums.segment<3>(3) += giving_arm(cell).cross(impulse);
}

/// Free cells whose centres are less than a cell from the sphere.
void SlipReturn::find_shell(std::size_t grain, const ImmersedGrain& sphere, Sums& sums) {
    const double outer = sphere.radius + grid().largest_size(sphere.position, sphere.radius);
    const Eigen::Vector3d way = sphere.moved.stableNormalized();
    for_rows_within(grid(), sphere.position, outer, [&](int j, int k, double y, double z) {
        const double square = outer * outer - (y * y + z * z);
        if (cells_.owns(j) && square > 0.0)
            find_shell_row({grain, j, k, {0.0, y, z}, std::sqrt(square), way}, sphere, sums);
    });
}

void SlipReturn::find_shell_row(const ShellRow& row, const ImmersedGrain& sphere, Sums& sums) {
    const int* owners = owners_.row(row.j, row.k);
    const LayerSpan along = grid().layers_within(0, sphere.position.x(), row.half);
    for (int i = along.low; i <= along.high; ++i) {
        const int column = grid().wrapped(0, i);
        const double x = grid().centre(0, i) - sphere.position.x();
        if (column < 0 || std::abs(x) >= row.half || owners[column] != CellOwners::none) continue;
        const Eigen::Vector3d arm(x, row.arm.y(), row.arm.z());
        // |n.U| over |U|
        const double weight = std::abs(arm.dot(row.way)) / arm.norm();
        const double mass = weight * field_.cell_mass(column, row.j);
        sums[6] += mass;
        sums.tail<3>() += mass * arm;
        shell_.push_back({row.grain, cells_.cell(column, row.j, row.k), weight});
    }
}

/// Neighbours across the three faces that look along the normal, 1, or against it, -1.
template <class Accept>
void SlipReturn::find_beside(const CrossedCell& cell, int direction, Accept accept,
                             std::vector<Beside>& found) const {
    found.clear();
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double normal = cell.arm[axis];
        if (normal == 0.0) continue;
        const int side = normal > 0.0 ? direction : -direction;
        const CellPlace at = cell.at.beside(axis, side);
        const CellPlace place{grid().wrapped(0, at.i), grid().wrapped(1, at.j),
                              grid().wrapped(2, at.k)};
        if (place.i < 0 || place.j < 0 || place.k < 0) continue;  // beyond a side
        Eigen::Vector3d arm = cell.arm;
        arm[axis] += axis == 1 ? grid().centre(1, at.j) - grid().centre(1, cell.at.j)
                               : side * grid().spacing[axis];
        if (!accept(owners_[place], arm)) continue;
        found.push_back({place, arm, std::abs(normal)});
        sum += std::abs(normal);
    }
    for (Beside& one : found) one.share /= sum;
}

/// Free ones; what is left together with the cell has no slip either.
void SlipReturn::find_outside(const CrossedCell& cell, const ImmersedGrain& sphere) {
    const auto free = [&](int owner, const Eigen::Vector3d& arm) {
        return owner == CellOwners::none && !was_inside(sphere, arm);
    };
    find_beside(cell, 1, free, outside_);
}

void SlipReturn::find_inside(const CrossedCell& cell) {
    const auto own = [&](int owner, const Eigen::Vector3d&) { return owner == cell.grain; };
    find_beside(cell, -1, own, inside_);
}

Eigen::Vector3d SlipReturn::velocity(const CellPlace& at) const {
    if (owns(at)) {
        const int cell = cells_.cell(at.i, at.j, at.k);
        return {u_[0][cell], u_[1][cell], u_[2][cell]};
    }
    const std::size_t cell = at.i + static_cast<std::size_t>(grid().counts[0]) * at.k;
    const bool below = at.j == grid().wrapped(1, cells_.first - 1);
    const std::array<std::vector<double>, 3>& layer = below ? beside_.below : beside_.above;
    return {layer[0][cell], layer[1][cell], layer[2][cell]};
}

Eigen::Vector3d SlipReturn::slip(const ImmersedGrain& sphere, const CellPlace& at,
                                 const Eigen::Vector3d& arm) const {
    // What a body force has given to all fluid is none.
    return velocity(at) - rigid_velocity(sphere.fluid_before(), arm);
}

/// Where the momentum that the sphere gives counts: in the cells that get it, or, behind it, in
/// those that transport has given it to.
Eigen::Vector3d SlipReturn::giving_arm(const CrossedCell& cell) {
    if (!cell.covered) find_inside(cell);
    const std::vector<Beside>& counted = cell.covered ? outside_ : inside_;
    if (counted.empty()) return cell.arm;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Beside& one : counted) mean += one.share * one.arm;
    return mean;
}

/// s of the cell, or behind the sphere of what is outside.
Eigen::Vector3d SlipReturn::returned(const CrossedCell& cell, const ImmersedGrain& sphere) const {
    if (cell.covered) return slip(sphere, cell.at, cell.arm);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Beside& outer : outside_) sum += outer.share * slip(sphere, outer.at, outer.arm);
    return sum;
}

void SlipReturn::give(const CrossedCell& cell, const Eigen::Vector3d& half) {
    if (!cell.covered) {
        change_.emplace_back(cells_.cell(cell.at.i, cell.at.j, cell.at.k), half);
        return;
    }
    const double volume = grid().relative_volume(cell.at.i, cell.at.j);
    for (const Beside& outer : outside_) {
        if (!owns(outer.at)) continue;
        // The same momentum in a cell that may be of another height
        const double share = outer.share * volume / grid().relative_volume(outer.at.i, outer.at.j);
        change_.emplace_back(cells_.cell(outer.at.i, outer.at.j, outer.at.k), share * half);
    }
}

}  // namespace turbidite
