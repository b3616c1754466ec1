// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The data of a sweep over contacts of spheres: eight doubles per body, one line of the cache, and
// per group of `width` contacts one packed record without indirection, apart from the bodies. All
// vectors are in world axes: no contact has a frame here. The loops over the records are in
// sphere_kernel.hpp.
//
// An empty lane has a zero normal and a positive bias: it never closes, and has a body slot of its
// own.
#pragma once

#include <cstdint>

#include "granular_adapter/nscd/sweeps/sweeps.hpp"

namespace turbidite::nscd {

struct alignas(64) SphereBody {
    double vx = 0.0, vy = 0.0, vz = 0.0;
    double inverse_mass = 0.0;
    double wx = 0.0, wy = 0.0, wz = 0.0;
    double inverse_inertia = 0.0;
};

/// 112 bytes per contact.
template <int lanes>
struct alignas(32) SphereRows {
    static constexpr int width = lanes;
    using Base = SphereRows;
    using Body = SphereBody;
    using Values = Lanes<lanes>;

    Values nx, ny, nz;
    Values bias_n;
    std::int32_t a[lanes] = {}, b[lanes] = {};
    Values rn, rx, ry, rz;  ///< r_n, and r_t as a vector
    Values friction;
    Values arm_a, arm_b;  ///< lengths of the arms
    Values inverse_nn, inverse_tt;
};

/// The same with a bias along the tangents, as a vector.
template <int lanes>
struct alignas(32) BiasedSphereRows : SphereRows<lanes> {
    using Values = Lanes<lanes>;
    Values bias_x, bias_y, bias_z;
};

/// The same with resistance to rolling and torsion; without it where neither body can rotate.
template <int lanes>
struct alignas(32) TurningSphereRows : BiasedSphereRows<lanes> {
    using Values = Lanes<lanes>;
    Values rolling, torsion;  ///< levers [m]
    Values mx, my, mz;        ///< moment impulse on b, as a vector
    Values bias_wx, bias_wy, bias_wz;
    Values inverse_rr;  ///< 1/(1/I_a + 1/I_b)
    Values length;      ///< turning_length()
};

/// The same with films of liquid (film.hpp).
template <int lanes>
struct alignas(32) FilmSphereRows : TurningSphereRows<lanes> {
    using Values = Lanes<lanes>;
    Values nn;                      ///< W_nn
    Values film_a, film_p, film_q;  ///< FilmEquation
    Values film_cutoff, film_offset;
    Values film_closed;  ///< r_f where the surfaces touch
};

}  // namespace turbidite::nscd
