// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A grain as seen by step 5 (Topin 2011, Eqs. 9-10): its position, the inertia it adds to the fluid
// it covers, and the motion it would have without that fluid. Plane motion: two velocity components
// and a spin. Valid C++17.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "coupler/rigid/rigid_motion.hpp"
#include "coupler/shapes/shape.hpp"

namespace turbidite {

/// (x, y, spin) of a velocity, an impulse or a momentum. A vector of Eigen, where messages have a
/// Twist: step 5 solves with matrices over these three.
using Planar = Eigen::Vector3d;

inline Planar planar(const Vec3& linear, const Vec3& angular) {
    return {linear[0], linear[1], angular[2]};
}
inline Planar planar(const Twist& twist) {
    return planar(twist.velocity, twist.spin);
}

inline Vec3 linear(const Planar& planar) {
    return {planar.x(), planar.y(), 0.0};
}
inline Vec3 angular(const Planar& planar) {
    return {0.0, 0.0, planar.z()};
}

/// Body to world.
inline Eigen::Matrix3d matrix(const Rotation& turn) {
    Eigen::Matrix3d rows;
    for (int k = 0; k < 3; ++k) rows.col(k) << turn.x[k], turn.y[k], turn.z[k];
    return rows;
}

struct ImmersedGrain {
    GrainId id = 0;
    const Shape* shape = nullptr;
    double radius = 0.0;                                        ///< hydrodynamic radius R_h [m]
    Eigen::Vector3d position = Eigen::Vector3d::Zero();         ///< q [m]
    Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();  ///< body to world
    double effective_mass = 0.0;                                ///< cM [kg/m]
    double effective_inertia = 0.0;                             ///< cI about z [kg m]
    Planar contact_motion = Planar::Zero();                     ///< U^{n+4/5}, omega^{n+4/5}
    bool has_boundary_points = true;  ///< if there are any; otherwise its cells are all it has
    bool prescribed = false;          ///< keeps contact_motion, whatever acts on it
    Planar announced_impulse = Planar::Zero();  ///< J_h and its moment
    Planar given_impulse = Planar::Zero();      ///< (M - m_f) g dt + J^n, unless U^{n+4/5} has them

    /// Momentum before the multipliers act: cM U^{n+4/5} + (M - m_f) g dt + J^n - J_h. J_h is
    /// already contained in U^{n+4/5} and is subtracted, since the multipliers include it. Finite
    /// also where cM <= 0.
    Planar momentum() const {
        return Planar(effective_mass, effective_mass, effective_inertia)
                   .cwiseProduct(contact_motion) +
               given_impulse - announced_impulse;
    }
};

inline std::vector<Planar> momenta_of(const std::vector<ImmersedGrain>& grains) {
    std::vector<Planar> momenta;
    for (const ImmersedGrain& grain : grains) momenta.push_back(grain.momentum());
    return momenta;
}

/// Zero for grains that are free.
inline std::vector<Planar> prescribed_motions(const std::vector<ImmersedGrain>& grains) {
    std::vector<Planar> motions;
    for (const ImmersedGrain& grain : grains)
        motions.push_back(grain.prescribed ? grain.contact_motion : Planar::Zero());
    return motions;
}

}  // namespace turbidite
