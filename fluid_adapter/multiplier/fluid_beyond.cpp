// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/fluid_beyond.hpp"

#include <Eigen/Geometry>

#include "fluid_adapter/multiplier/cell_grid.hpp"
#include "fluid_adapter/multiplier/immersed_grain.hpp"

namespace turbidite {
namespace {

constexpr int per_axis = 24;  // along each axis of the box around a grain

/// Whether a place is beyond a side that is open; `reach`: or less than that from it.
bool is_beyond(const CellGrid& grid, const Eigen::Vector3d& place, double reach) {
    for (int axis = 0; axis < grid.dimension; ++axis) {
        const double from_lower = place[axis] - grid.origin[axis];
        const double from_upper = grid.length(axis) - from_lower;
        if (grid.sides[axis][0] == Side::open && from_lower < reach) return true;
        if (grid.sides[axis][1] == Side::open && from_upper < reach) return true;
    }
    return false;
}

bool contains(const CellGrid& grid, const ImmersedGrain& grain, const Eigen::Vector3d& arm) {
    if (grid.dimension == 3) return arm.norm() < grain.radius;
    return grain.shape->contains(grain.orientation.transpose() * arm, grain.radius);
}

}  // namespace

Impulse FluidBeyond::momentum(const Twist& motion) const {
    const Eigen::Vector3d velocity(motion.velocity[0], motion.velocity[1], motion.velocity[2]);
    const Eigen::Vector3d spin(motion.spin[0], motion.spin[1], motion.spin[2]);
    // sum m r x (U + omega x r) = (sum m r) x U + (tr Q - Q) omega, Q = sum m r r^T
    const Eigen::Vector3d linear = mass * velocity + spin.cross(first);
    const Eigen::Vector3d moment = first.cross(velocity) + second.trace() * spin - second * spin;
    return {{linear.x(), linear.y(), linear.z()}, {moment.x(), moment.y(), moment.z()}};
}

FluidBeyond fluid_beyond(const CellGrid& grid, const ImmersedGrain& grain, double displaced_mass) {
    FluidBeyond sums;
    if (!is_beyond(grid, grain.position, grain.radius)) return sums;
    const auto along = [&](int i) { return grain.radius * ((2 * i + 1.0) / per_axis - 1.0); };
    const int deep = grid.dimension == 3 ? per_axis : 1;
    double inside = 0.0;
    for (int k = 0; k < deep; ++k)
        for (int j = 0; j < per_axis; ++j)
            for (int i = 0; i < per_axis; ++i) {
                const Eigen::Vector3d arm(along(i), along(j), deep > 1 ? along(k) : 0.0);
                if (!contains(grid, grain, arm)) continue;
                inside += 1.0;
                if (!is_beyond(grid, grain.position + arm, 0.0)) continue;
                sums.mass += 1.0;
                sums.first += arm;
                sums.second += arm * arm.transpose();
            }
    // All places together have the mass of the whole grain's fluid.
    const double m = inside > 0.0 ? displaced_mass / inside : 0.0;
    sums.mass *= m, sums.first *= m, sums.second *= m;
    return sums;
}

}  // namespace turbidite
