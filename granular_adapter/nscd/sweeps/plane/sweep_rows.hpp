// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The data of a sweep: four doubles per body, and per group of `width` contacts one packed record
// without indirection, apart from the bodies. In this folder "rows" (DiscRows, ...) means such a
// record. Plain arrays; the loops over them are in sweep_kernel.hpp.
//
// Moment arms are (arm x d)_z for d = n, t [m]. An empty lane has a zero normal and a positive
// bias: it never closes, and has a body slot of its own.
#pragma once

#include <cstdint>

#include "granular_adapter/nscd/problem/plane/one_contact.hpp"
#include "granular_adapter/nscd/sweeps/sweeps.hpp"

namespace turbidite::nscd {

/// Four doubles where a Twist has six: a sweep reads one register per body.
struct alignas(32) PlaneBody {
    double x = 0.0, y = 0.0, spin = 0.0;
    double inverse_mass = 0.0;  ///< used if mobilities are isotropic
};

template <int lanes>
struct RowBase {
    static constexpr int width = lanes;
    using Base = RowBase;
    using Body = PlaneBody;
    using Values = Lanes<lanes>;

    // The three cache lines read by the test of groups at rest; updates write one of them.
    Values nx, ny;
    Values bias_n;
    std::int32_t a[lanes] = {}, b[lanes] = {};
    Values rn, rt;
    Values bias_t, friction;
};

/// W_nt = 0 and isotropic mobility: discs, and bodies with arms along the normal.
template <int lanes>
struct alignas(64) DiscRows : RowBase<lanes> {
    using Values = Lanes<lanes>;
    Values arm_a, arm_b;    ///< of the tangent
    Values turn_a, turn_b;  ///< the same over the moment of inertia
    Values inverse_nn, inverse_tt;
};

/// The same with rolling resistance, which is coupled to friction through the spins.
template <int lanes>
struct alignas(64) RollingDiscRows : DiscRows<lanes> {
    using Values = Lanes<lanes>;
    Values rolling;                ///< lever [m]
    Values roll;                   ///< moment impulse [N m s]
    Values bias_roll;              ///< of w [rad/s]
    Values spin_a, spin_b;         ///< 1/I
    Values tt, tr, rr;             ///< entries of W
    Values inverse_a, inverse_rr;  ///< A = W_tt - W_tr^2/W_rr
    Values length;                 ///< rolling_length()
};

/// Any W, any mobility. The changes of velocity due to a unit impulse along n or t are precomputed
/// for both bodies, so that a push is one multiplication and addition per component and direction.
template <int lanes>
struct alignas(64) GeneralRows : RowBase<lanes> {
    using Values = Lanes<lanes>;
    Values arm_an, arm_at, arm_bn, arm_bt;
    Values a_nx, a_ny, a_ns, a_tx, a_ty, a_ts;  ///< M^-1 (d, arm x d), d = n, t
    Values b_nx, b_ny, b_ns, b_tx, b_ty, b_ts;
    Values nn, nt, tt;                         ///< entries of W
    Values inverse_nn, inverse_a;              ///< A = W_tt - W_nt^2/W_nn
    Values inverse_forward, inverse_backward;  ///< 1/(W_nn + s mu W_nt), s = 1, -1
};

/// The same with rolling resistance and films, whose root takes iterations; one contact at a time.
template <int lanes>
struct AnyRows : GeneralRows<lanes> {
    static_assert(lanes == 1);
    double a_rx = 0.0, a_ry = 0.0, a_rs = 0.0;  ///< M^-1 (0, 0, 1)
    double b_rx = 0.0, b_ry = 0.0, b_rs = 0.0;
    double rolling = 0.0;
    double roll = 0.0;
    double bias_roll = 0.0;
    double length = 1.0;
    Block w;
};

}  // namespace turbidite::nscd
