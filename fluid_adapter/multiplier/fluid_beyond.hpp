// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The fluid of a grain that leaves through a free side, in the part of it that is beyond the grid.
// There are no cells there, but cM = M - rho_f V(R_h) counts on the fluid of the whole grain: that
// part is taken to move with the grain as it did before the window. Otherwise the part outside
// would have the inertia of its excess mass alone, and a grain hardly denser than the fluid none at
// all. Valid C++17.
#pragma once

#include <Eigen/Core>

#include "coupler/rigid/impulse.hpp"
#include "coupler/rigid/rigid_motion.hpp"

namespace turbidite {

struct CellGrid;
struct ImmersedGrain;

/// Sums over that part with r from the grain's centre, per unit length in the plane.
struct FluidBeyond {
    double mass = 0.0;                                 ///< sum m [kg]
    Eigen::Vector3d first = Eigen::Vector3d::Zero();   ///< sum m r [kg m]
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< sum m r r^T [kg m2]

    /// sum m (u, r x u) of u = U + omega x r.
    Impulse momentum(const Twist& motion) const;
};

/// Of a grain whose R_h displaces `displaced_mass` of fluid; nothing unless it reaches beyond a
/// side that is open.
FluidBeyond fluid_beyond(const CellGrid& grid, const ImmersedGrain& grain, double displaced_mass);

}  // namespace turbidite
