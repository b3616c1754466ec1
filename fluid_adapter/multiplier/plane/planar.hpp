// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What step 5 solves with in the plane: two components of a velocity and a spin, as a vector of
// Eigen, since matrices act on these three. Messages have Twist and Impulse. Valid C++17.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fluid_adapter/multiplier/immersed_grain.hpp"

namespace turbidite {

/// (x, y, spin) of a velocity, an impulse or a momentum.
using Planar = Eigen::Vector3d;

inline Planar planar(const Twist& twist) {
    return {twist.velocity[0], twist.velocity[1], twist.spin[2]};
}
inline Planar planar(const Impulse& impulse) {
    return {impulse.linear[0], impulse.linear[1], impulse.moment[2]};
}

inline Twist twist(const Planar& planar) {
    return {{planar.x(), planar.y(), 0.0}, {0.0, 0.0, planar.z()}};
}
inline Impulse impulse(const Planar& planar) {
    return {{planar.x(), planar.y(), 0.0}, {0.0, 0.0, planar.z()}};
}

inline std::vector<Planar> momenta_of(const std::vector<ImmersedGrain>& grains) {
    std::vector<Planar> momenta;
    for (const ImmersedGrain& grain : grains) momenta.push_back(planar(grain.momentum()));
    return momenta;
}

/// Zero for grains that are free.
inline std::vector<Planar> prescribed_motions(const std::vector<ImmersedGrain>& grains) {
    std::vector<Planar> motions;
    for (const ImmersedGrain& grain : grains)
        motions.push_back(planar(grain.prescribed ? grain.contact_motion : Twist{}));
    return motions;
}

}  // namespace turbidite
