// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Arithmetic on the lanes of a group (sweeps.hpp), for the kernels of all kinds of contact. This
// file is included once per instruction set, inside a namespace of that name, before the kernel.
// Values are vectors of four doubles or single doubles; every operation rounds lane by lane, so
// neither the width nor the instruction set changes a bit.

#define TURBIDITE_INLINE [[gnu::always_inline]] inline

using Four = double __attribute__((vector_size(32)));

template <int width>
struct RealOf {
    using Type = Four;
};
template <>
struct RealOf<1> {
    using Type = double;
};
template <int width>
using Real = typename RealOf<width>::Type;

template <int width>
TURBIDITE_INLINE Real<width> load(const Lanes<width>& lanes) {
    Real<width> value;
    __builtin_memcpy(&value, lanes.v, sizeof value);
    return value;
}

template <int width>
TURBIDITE_INLINE void store(Lanes<width>& lanes, const Real<width>& value) {
    __builtin_memcpy(lanes.v, &value, sizeof value);
}

// Same semantics as std::max and std::min: the second argument if the comparison fails.
template <class R>
TURBIDITE_INLINE R larger(const R& a, const R& b) {
    return a > b ? a : b;
}
template <class R>
TURBIDITE_INLINE R smaller(const R& a, const R& b) {
    return a < b ? a : b;
}
template <class R>
TURBIDITE_INLINE R clamped(const R& x, const R& limit) {
    return smaller(larger(x, R(-limit)), limit);
}
template <class R>
TURBIDITE_INLINE R magnitude(const R& x) {
    return larger(x, R(-x));
}

// The square root is rounded correctly by every processor, hence the same bits in any width.
TURBIDITE_INLINE double root(double x) {
    return __builtin_sqrt(x);
}
TURBIDITE_INLINE Four root(const Four& x) {
    Four result;
    for (int lane = 0; lane < 4; ++lane) result[lane] = root(x[lane]);
    return result;
}

TURBIDITE_INLINE bool any(double x) {
    return x != 0.0;
}
TURBIDITE_INLINE bool any(const Four& x) {
    return x[0] != 0.0 || x[1] != 0.0 || x[2] != 0.0 || x[3] != 0.0;
}

/// Counts contacts whose new impulse is not zero; that of a film may be negative.
template <int width, class R>
TURBIDITE_INLINE void count_loaded(PassSums<width>& sums, const R& rn) {
    const R one = R{} + 1.0;
    store(sums.loaded, R(load(sums.loaded) + (magnitude(rn) > R{} ? one : R{})));
}
