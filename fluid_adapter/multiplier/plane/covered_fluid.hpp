// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Elimination of the interior multipliers: the cells inside a grain move with it, so grain and
// covered fluid are one rigid body. With m = rho_f V_c of each cell and r from the grain's centre,
// summed over its interior cells,
//
//     A  =  diag(cM, cM, cI)  +  sum m [ 1     0    -r_y ]      symmetric
//                                      [ 0     1     r_x ]
//                                      [-r_y   r_x   r^2 ]
//     P  =  diag(cM, cM, cI) U45 + (M - m_f) g dt - J_h  +  sum m (u_x, u_y, r_x u_y - r_y u_x)
//
// and, without boundary points, the body moves with A^-1 P. A is positive definite for grains of
// any density that cover fluid, also where cM <= 0. Valid C++17.
#pragma once

#include <Eigen/Core>

#include "fluid_adapter/multiplier/components.hpp"
#include "fluid_adapter/multiplier/plane/collocation_points.hpp"
#include "fluid_adapter/multiplier/plane/planar.hpp"

namespace turbidite {

/// Sums over the interior cells of a grain, weighted by V_c over the reference cell's volume: 1,
/// r_x, r_y, r^2.
using CellSums = Eigen::Matrix<double, 4, 1>;

/// The sums over this rank's cells for grain g.
CellSums sum_cells(const CollocationPoints& points, int g);

/// Those of fluid beyond a free side, as many of the reference cells, of mass m.
CellSums sums_of(const FluidBeyond& beyond, double m);

/// The same of u_x, u_y, r x u [m/s, m2/s].
Planar sum_velocity(const CollocationPoints& points, const VelocityPointers& velocity, int g);

/// A [kg, kg m, kg m2 per unit length].
Eigen::Matrix3d body_inertia(const ImmersedGrain& grain, const CellSums& sums,
                             double reference_mass);

/// Sets this rank's interior cells of grain g to the rigid motion; returns the impulse and its
/// moment lost by the fluid.
Planar carry_cells(const CollocationPoints& points, const VelocityPointers& velocity, int g,
                   const Planar& motion, double reference_mass);

}  // namespace turbidite
