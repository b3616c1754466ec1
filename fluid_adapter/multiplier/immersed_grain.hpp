// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A grain as seen by step 5 (Topin 2011, Eqs. 9-10): its position, the inertia it adds to the fluid
// it covers, and the motion it would have without that fluid. Valid C++17.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "coupler/rigid/impulse.hpp"
#include "coupler/rigid/rigid_motion.hpp"
#include "coupler/shapes/shape.hpp"
#include "coupler/shapes/wall_surface.hpp"
#include "fluid_adapter/multiplier/fluid_beyond.hpp"

namespace turbidite {

/// Body to world.
inline Eigen::Matrix3d matrix(const Rotation& turn) {
    Eigen::Matrix3d rows;
    for (int k = 0; k < 3; ++k) rows.col(k) << turn.x[k], turn.y[k], turn.z[k];
    return rows;
}

/// A wall inside the box in space: all that is within half its thickness of its surface.
struct WallBody {
    WallSurface surface;
    double half_thickness = 0.0;  ///< as the fluid sees it [m]

    friend bool operator==(const WallBody& a, const WallBody& b) {
        return a.half_thickness == b.half_thickness && a.surface == b.surface;
    }
};

struct ImmersedGrain {
    GrainId id = 0;
    const Shape* shape = nullptr;    ///< null of a wall in space
    const WallBody* wall = nullptr;  ///< null of all other bodies; with `radius` 0
    double radius = 0.0;             ///< hydrodynamic radius R_h [m]
    Eigen::Vector3d position = Eigen::Vector3d::Zero();         ///< q [m]
    Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();  ///< body to world
    double effective_mass = 0.0;      ///< cM [kg], per unit length in the plane
    double effective_inertia = 0.0;   ///< cI: about z [kg m], of a sphere about any axis [kg m2]
    Twist contact_motion{};           ///< U^{n+4/5}, omega^{n+4/5}
    bool has_boundary_points = true;  ///< if there are any; otherwise its cells are all it has
    bool prescribed = false;          ///< keeps contact_motion, whatever acts on it
    Impulse announced_impulse{};      ///< J_h and its moment
    Impulse given_impulse{};          ///< (M - m_f) g dt + J^n, unless U^{n+4/5} has them
    /// rho_f (V(R) - V(R_h)) a dt: a body force a on the fluid acts on all cells of V(R_h), the
    /// mean pressure gradient that it stands for on V(R). None where the motion is prescribed.
    Vec3 driving_impulse{};
    FluidBeyond beyond{};   ///< of a grain that leaves
    Twist motion_before{};  ///< U^n, omega^n
    /// By which the position has changed since the last window [m]; zero where no cell is to be
    /// told apart by it.
    Eigen::Vector3d moved = Eigen::Vector3d::Zero();
    Vec3 stream_gain{};  ///< a dt, which the body force has given all fluid since U^n [m/s]

    /// Of fluid that has moved with it and felt the body force: that beyond a free side.
    Twist fluid_before() const {
        return {motion_before.velocity + stream_gain, motion_before.spin};
    }

    /// Momentum before the multipliers act: cM U^{n+4/5} + (M - m_f) g dt + J^n - J_h, the driving
    /// impulse, and the momentum of the fluid beyond a free side. J_h is already contained in
    /// U^{n+4/5} and is subtracted, since the multipliers include it. Finite also where cM <= 0.
    Impulse momentum() const {
        const Impulse own{effective_mass * contact_motion.velocity,
                          effective_inertia * contact_motion.spin};
        return own + beyond.momentum(fluid_before()) + given_impulse +
               Impulse{driving_impulse, {}} - announced_impulse;
    }
};

inline bool any_prescribed(const std::vector<ImmersedGrain>& grains) {
    return std::any_of(grains.begin(), grains.end(),
                       [](const ImmersedGrain& grain) { return grain.prescribed; });
}

}  // namespace turbidite
