// SPDX-License-Identifier: LGPL-2.1-or-later
//
// All that a sweep touches: four doubles per body, one flat group of rows per `width` contacts,
// nothing indirect beside the bodies. Plain arrays; the loops over them are in sweep_kernel.hpp.
//
// Moment arms are (arm x d)_z for d = n, t [m]. An empty lane has no normal and a positive bias: it
// never closes, and touches a body of its own.
#pragma once

#include <cstdint>

#include "granular_adapter/nscd/problem/plane/one_contact.hpp"

namespace turbidite::nscd {

struct alignas(32) PlaneBody {
    double x = 0.0, y = 0.0, spin = 0.0;
    double inverse_mass = 0.0;  ///< read where mobilities are isotropic
};

/// One value for each contact of a group.
template <int width>
struct alignas(8 * width) Lanes {
    double v[width] = {};
};

template <int lanes>
struct RowBase {
    static constexpr int width = lanes;
    using Values = Lanes<lanes>;

    // Three cache lines for groups that are only looked at, one of them written to by the others.
    Values nx, ny;
    Values bias_n;
    std::int32_t a[lanes] = {}, b[lanes] = {};
    Values rn, rt;
    Values bias_t, friction;
};

/// W_nt = 0 and isotropic bodies: discs, and whatever touches with arms along the normal.
template <int lanes>
struct alignas(64) DiscRows : RowBase<lanes> {
    using Values = Lanes<lanes>;
    Values arm_a, arm_b;    ///< tangential
    Values turn_a, turn_b;  ///< the same over the moment of inertia
    Values inverse_nn, inverse_tt;
};

/// The same with resistance to rolling, which friction and it share through the spins.
template <int lanes>
struct alignas(64) RollingDiscRows : DiscRows<lanes> {
    using Values = Lanes<lanes>;
    Values rolling;                ///< lever [m]
    Values roll;                   ///< moment impulse
    Values spin_a, spin_b;         ///< 1/I
    Values tt, tr, rr;             ///< of W
    Values inverse_a, inverse_rr;  ///< A = W_tt - W_tr^2/W_rr
    Values length;                 ///< rolling_length()
};

/// Any W, any mobility. What a unit impulse along n or t does to each body is known before the
/// sweeps, so that a push is one multiplication and addition per component and direction.
template <int lanes>
struct alignas(64) GeneralRows : RowBase<lanes> {
    using Values = Lanes<lanes>;
    Values arm_an, arm_at, arm_bn, arm_bt;
    Values a_nx, a_ny, a_ns, a_tx, a_ty, a_ts;  ///< M^-1 (d, arm x d), d = n, t
    Values b_nx, b_ny, b_ns, b_tx, b_ty, b_ts;
    Values nn, nt, tt;                         ///< of W
    Values inverse_nn, inverse_a;              ///< A = W_tt - W_nt^2/W_nn
    Values inverse_forward, inverse_backward;  ///< 1/(W_nn + s mu W_nt), s = 1, -1
};

/// The same with resistance to rolling: rare, one contact at a time.
template <int lanes>
struct GeneralRollingRows : GeneralRows<lanes> {
    static_assert(lanes == 1);
    double a_rx = 0.0, a_ry = 0.0, a_rs = 0.0;  ///< M^-1 (0, 0, 1)
    double b_rx = 0.0, b_ry = 0.0, b_rs = 0.0;
    double rolling = 0.0;
    double roll = 0.0;
    double length = 1.0;
    Block w;
};

/// Sums over the contacts of a pass, lane by lane.
template <int width>
struct PassSums {
    Lanes<width> error;   ///< |natural map|^2
    Lanes<width> size;    ///< |r|^2
    Lanes<width> loaded;  ///< contacts that have an impulse after their update
};

template <int width>
double total(const Lanes<width>& lanes) {
    double sum = 0.0;
    for (const double value : lanes.v) sum += value;
    return sum;
}

/// Updates every contact of the groups [begin, end); `measured` adds the state that each contact
/// met to the sums as well. `asked` is for groups that are expected to be at rest: those where no
/// contact has an impulse or closes are only looked at; says which have one after it.
template <class Rows>
struct Sweeps {
    using Sums = PassSums<Rows::width>;
    void (*plain)(Rows* begin, Rows* end, PlaneBody* bodies) = nullptr;
    void (*measured)(Rows* begin, Rows* end, PlaneBody* bodies, Sums& sums) = nullptr;
    void (*asked)(Rows* begin, Rows* end, PlaneBody* bodies, Sums& sums,
                  std::uint8_t* awake) = nullptr;
};

/// What the loops are compiled for. The bits are the same.
enum class Instructions { portable, avx2 };

bool available(Instructions instructions);
Instructions best_instructions();

/// Throws std::invalid_argument when the processor lacks the instructions. For the four kinds of
/// rows at four lanes (general rolling rows: one) and, as the reference in tests, at one.
template <class Rows>
Sweeps<Rows> sweeps(Instructions instructions);

template <class Rows>
Sweeps<Rows> avx2_sweeps();  ///< sweep_avx2.cpp

}  // namespace turbidite::nscd
