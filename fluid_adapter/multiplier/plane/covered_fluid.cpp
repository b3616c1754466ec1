// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/plane/covered_fluid.hpp"

#include "fluid_adapter/multiplier/memory_prefetch.hpp"

namespace turbidite {
namespace {

/// Asks for the velocities in a grain's cells, which lie far apart in memory, before they are
/// needed.
void expect_cells(const CollocationPoints& points, int g, const double* ux, const double* uy) {
    constexpr int every = 4;  // half of a line of memory
    if (g >= points.grains()) return;
    for (int i = points.interior_begin[g]; i < points.interior_begin[g + 1]; i += every) {
        ask_for(&ux[points.interior[i].cell]);
        ask_for(&uy[points.interior[i].cell]);
    }
}

}  // namespace

CellSums sum_cells(const CollocationPoints& points, int g) {
    CellSums sums = CellSums::Zero();
    for (int i = points.interior_begin[g]; i < points.interior_begin[g + 1]; ++i) {
        const InteriorCell& at = points.interior[i];
        sums += at.volume *
                CellSums(1.0, at.arm_x, at.arm_y, at.arm_x * at.arm_x + at.arm_y * at.arm_y);
    }
    return sums;
}

CellSums sums_of(const FluidBeyond& beyond, double m) {
    return CellSums(beyond.mass, beyond.first.x(), beyond.first.y(), beyond.second.trace()) / m;
}

Planar sum_velocity(const CollocationPoints& points, const VelocityPointers& velocity, int g) {
    const double *ux = velocity[0], *uy = velocity[1];
    expect_cells(points, g + 1, ux, uy);
    // sum V_c (u_x, u_y, r_x u_y - r_y u_x), V_c relative to the reference cell
    double x = 0.0, y = 0.0, moment = 0.0;
    for (int i = points.interior_begin[g]; i < points.interior_begin[g + 1]; ++i) {
        const InteriorCell& at = points.interior[i];
        x += at.volume * ux[at.cell];
        y += at.volume * uy[at.cell];
        moment += at.volume * (at.arm_x * uy[at.cell] - at.arm_y * ux[at.cell]);
    }
    return {x, y, moment};
}

Eigen::Matrix3d body_inertia(const ImmersedGrain& grain, const CellSums& sums, double m) {
    // A = diag(cM, cM, cI) + m [ s0 0 -s2; 0 s0 s1; -s2 s1 s3 ], s = sums
    const double mass = grain.effective_mass + m * sums[0];
    Eigen::Matrix3d inertia;
    inertia << mass, 0.0, -m * sums[2],  //
        0.0, mass, m * sums[1],          //
        -m * sums[2], m * sums[1], grain.effective_inertia + m * sums[3];
    return inertia;
}

Planar carry_cells(const CollocationPoints& points, const VelocityPointers& velocity, int g,
                   const Planar& motion, double reference_mass) {
    double *ux = velocity[0], *uy = velocity[1];
    expect_cells(points, g + 1, ux, uy);
    double lost_x = 0.0, lost_y = 0.0, moment = 0.0;
    for (int i = points.interior_begin[g]; i < points.interior_begin[g + 1]; ++i) {
        const InteriorCell& point = points.interior[i];
        // u <- U + omega x r; what the cell loses is m_c (u - U - omega x r).
        const double x = motion.x() - motion.z() * point.arm_y;
        const double y = motion.y() + motion.z() * point.arm_x;
        const double dx = ux[point.cell] - x, dy = uy[point.cell] - y;
        lost_x += point.volume * dx;
        lost_y += point.volume * dy;
        moment += point.volume * (point.arm_x * dy - point.arm_y * dx);
        ux[point.cell] = x;
        uy[point.cell] = y;
    }
    // What the fluid loses the grain gains: part of its multiplier impulse.
    return reference_mass * Planar(lost_x, lost_y, moment);
}

}  // namespace turbidite
