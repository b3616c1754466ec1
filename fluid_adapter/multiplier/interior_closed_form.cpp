// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/interior_closed_form.hpp"

#include <Eigen/LU>
#include <stdexcept>

namespace turbidite {
namespace {

/// Sums over the cells of a grain: count, r_x, r_y, r^2, u_x, u_y, r x u.
using CellSums = Eigen::Matrix<double, 7, 1>;

CellSums sum_cells(const CollocationPoints& points, FluidField& field, int g) {
    CellSums sums = CellSums::Zero();
    for (int p = points.begin[g]; p < points.begin[g + 1]; ++p) {
        const int cell = points.cell[points.stencil[p]];
        const double x = points.arm_x[p], y = points.arm_y[p];
        const double ux = field.velocity(0)[cell], uy = field.velocity(1)[cell];
        CellSums add;
        add << 1.0, x, y, x * x + y * y, ux, uy, x * uy - y * ux;
        sums += add;
    }
    return sums;
}

Planar common_motion(const ImmersedGrain& grain, const CellSums& sums, double m) {
    const double mass = grain.effective_mass + m * sums[0];
    Eigen::Matrix3d inertia;
    inertia << mass, 0.0, -m * sums[2],  //
        0.0, mass, m * sums[1],          //
        -m * sums[2], m * sums[1], grain.effective_inertia + m * sums[3];
    const Planar free = grain.free_motion();
    const Planar momentum(grain.effective_mass * free.x() + m * sums[4],
                          grain.effective_mass * free.y() + m * sums[5],
                          grain.effective_inertia * free.z() + m * sums[6]);
    return inertia.partialPivLu().solve(momentum);
}

void impose_motion(const CollocationPoints& points, FluidField& field, int g, const Planar& motion,
                   double* impulses) {
    const double m = field.cell_mass();
    for (int p = points.begin[g]; p < points.begin[g + 1]; ++p) {
        const int cell = points.cell[points.stencil[p]];
        double& ux = field.velocity(0)[cell];
        double& uy = field.velocity(1)[cell];
        const double x = motion.x() - motion.z() * points.arm_y[p];
        const double y = motion.y() + motion.z() * points.arm_x[p];
        impulses[p] = m * (ux - x);
        impulses[points.size() + p] = m * (uy - y);
        ux = x;
        uy = y;
    }
}

}  // namespace

MultiplierResult interior_closed_form(SaddlePoint& system, const MultiplierSettings&,
                                      MultiplierWorkspace& work) {
    const CollocationPoints& points = system.points();
    if (static_cast<int>(points.cell.size()) != points.size())
        throw std::invalid_argument("the closed form needs interior points only");
    work.resize(system.rows());

    std::vector<CellSums> sums(system.grains().size());
    for (int g = 0; g < points.grains(); ++g) sums[g] = sum_cells(points, system.field(), g);
    system.sum_over_holders(sums);
    for (int g = 0; g < points.grains(); ++g) {
        system.motions()[g] =
            common_motion(system.grains()[g], sums[g], system.field().cell_mass());
        impose_motion(points, system.field(), g, system.motions()[g], work.impulses.data());
    }
    ConstraintOperator(points).sum_by_grain(work.impulses.data(), system.impulses().data());
    system.sum_over_holders(system.impulses());
    return {};
}

}  // namespace turbidite
