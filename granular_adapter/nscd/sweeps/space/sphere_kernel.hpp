// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The update of a group of contacts of spheres (sphere_rows.hpp). This file is included once per
// instruction set, between lane_kernel.hpp and sweep_loops.hpp.
//
//     u_n = n.(v_b - v_a) + b_n
//     u_t = (v_b - v_a) - (n.(v_b - v_a)) n - (r_a w_a + r_b w_b) x n + b_t
//     r_n' = max(0, r_n - u_n/W_nn)
//     r_t' = r_t - u_t/W_tt, shortened to mu r_n' where it is longer
//     v_b += 1/m_b p,  w_b -= r_b/I_b n x (r_t' - r_t),    p = (r_n' - r_n) n + r_t' - r_t
//     v_a -= 1/m_a p,  w_a -= r_a/I_a n x (r_t' - r_t)
//
// The arms are r_a n and -r_b n. With resistance to rolling and torsion then, at the new spins,
//
//     m' = m - (w_b - w_a + b_w)/W_rr, its part along n shortened to torsion r_n', the other to
//     rolling r_n';   w_b += 1/I_b (m' - m),  w_a -= 1/I_a (m' - m)
//
// which is exact for a contact alone where r_a/I_a = r_b/I_b: there m does not change u_t. With a
// film r_n' is that of film.hpp, and the limits are times the part of it that the contact carries.

template <class R>
struct Vector {
    R x, y, z;
};

template <class R>
TURBIDITE_INLINE Vector<R> operator+(const Vector<R>& a, const Vector<R>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class R>
TURBIDITE_INLINE Vector<R> operator-(const Vector<R>& a, const Vector<R>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class R>
TURBIDITE_INLINE Vector<R> operator*(const R& factor, const Vector<R>& a) {
    return {factor * a.x, factor * a.y, factor * a.z};
}
template <class R>
TURBIDITE_INLINE R product(const Vector<R>& a, const Vector<R>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class R>
TURBIDITE_INLINE Vector<R> cross(const Vector<R>& a, const Vector<R>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class R>
TURBIDITE_INLINE R length(const Vector<R>& a) {
    return root(R(product(a, a)));
}

/// Shortened to `most` where it is longer.
template <class R>
TURBIDITE_INLINE Vector<R> clipped(const Vector<R>& a, const R& most) {
    const R one = R{} + 1.0, size = length(a);
    const R from = size > most ? size : one, to = size > most ? most : one;
    return R(to / from) * a;
}

/// Velocity and 1/m, or spin and 1/I.
template <class R>
struct Motion {
    Vector<R> rate;
    R inverse;
};

TURBIDITE_INLINE Four four_at(const double* from) {
    Four value;
    __builtin_memcpy(&value, __builtin_assume_aligned(from, 32), sizeof value);
    return value;
}
TURBIDITE_INLINE void put(double* to, const Four& value) {
    __builtin_memcpy(__builtin_assume_aligned(to, 32), &value, sizeof value);
}

TURBIDITE_INLINE void transpose(Four& a, Four& b, Four& c, Four& d) {
    const Four ab02 = __builtin_shufflevector(a, b, 0, 4, 2, 6);
    const Four ab13 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Four cd02 = __builtin_shufflevector(c, d, 0, 4, 2, 6);
    const Four cd13 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    a = __builtin_shufflevector(ab02, cd02, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab13, cd13, 0, 1, 4, 5);
    c = __builtin_shufflevector(ab02, cd02, 2, 3, 6, 7);
    d = __builtin_shufflevector(ab13, cd13, 2, 3, 6, 7);
}

/// `member`: the first of the four doubles of a body.
TURBIDITE_INLINE Motion<Four> gather(const SphereBody* bodies, const std::int32_t (&at)[4],
                                     double SphereBody::*member) {
    Four x = four_at(&(bodies[at[0]].*member)), y = four_at(&(bodies[at[1]].*member));
    Four z = four_at(&(bodies[at[2]].*member)), inverse = four_at(&(bodies[at[3]].*member));
    transpose(x, y, z, inverse);
    return {{x, y, z}, inverse};
}
TURBIDITE_INLINE Motion<double> gather(const SphereBody* bodies, const std::int32_t (&at)[1],
                                       double SphereBody::*member) {
    const double* const from = &(bodies[at[0]].*member);
    return {{from[0], from[1], from[2]}, from[3]};
}

TURBIDITE_INLINE void scatter(SphereBody* bodies, const std::int32_t (&at)[4],
                              double SphereBody::*member, const Motion<Four>& motion) {
    Four first = motion.rate.x, second = motion.rate.y, third = motion.rate.z;
    Four fourth = motion.inverse;
    transpose(first, second, third, fourth);
    put(&(bodies[at[0]].*member), first);
    put(&(bodies[at[1]].*member), second);
    put(&(bodies[at[2]].*member), third);
    put(&(bodies[at[3]].*member), fourth);
}
TURBIDITE_INLINE void scatter(SphereBody* bodies, const std::int32_t (&at)[1],
                              double SphereBody::*member, const Motion<double>& motion) {
    double* const to = &(bodies[at[0]].*member);
    to[0] = motion.rate.x, to[1] = motion.rate.y, to[2] = motion.rate.z;
}

constexpr double SphereBody::*velocity_of = &SphereBody::vx;
constexpr double SphereBody::*spin_of = &SphereBody::wx;

template <int width>
TURBIDITE_INLINE Vector<Real<width>> load(const Lanes<width>& x, const Lanes<width>& y,
                                          const Lanes<width>& z) {
    return {load(x), load(y), load(z)};
}

/// Adds |natural map|^2 and |r|^2 (problem/space/one_contact.hpp).
template <int width, class R>
TURBIDITE_INLINE void add_map(PassSums<width>& sums, const R& rn, const Vector<R>& rt, const R& un,
                              const Vector<R>& ut, const R& mu, const R& rho) {
    const R one = R{} + 1.0;
    // r - rho (u + (mu |u_t|, 0))
    const R n = rn - rho * (un + mu * length(ut));
    const Vector<R> t = rt - rho * ut;
    const R edge = (n + mu * length(t)) / (one + mu * mu);
    const R on = larger(larger(n, edge), R{});
    const R fn = rn - on;
    const Vector<R> ft = rt - clipped(t, R(mu * on));
    store(sums.error, R(load(sums.error) + (fn * fn + product(ft, ft))));
    store(sums.size, R(load(sums.size) + (rn * rn + product(rt, rt))));
}

/// n of the closest point of the cone with three limits (problem/space/turning_contact.hpp).
template <class R>
TURBIDITE_INLINE R nearest_normal(const R& n, const R (&size)[3], const R (&slope)[3]) {
    R largest{};
    // The limits in a set are reached: n = (x_n + sum slope |x|)/(1 + sum slope^2), the largest of
    // all sets.
    for (unsigned set = 0; set < 8; ++set) {
        R sum = n, square = R{} + 1.0;
        for (unsigned i = 0; i < 3; ++i)
            if (set >> i & 1u) sum += slope[i] * size[i], square += slope[i] * slope[i];
        largest = larger(R(sum / square), largest);
    }
    return largest;
}

/// A vector as its parts across and along the normal.
template <class R>
struct Parts {
    Vector<R> across, along;
};
template <class R>
TURBIDITE_INLINE Parts<R> parts(const Vector<R>& x, const Vector<R>& normal) {
    const Vector<R> along = product(normal, x) * normal;
    return {x - along, along};
}

/// The same as add_map with moments.
template <class Rows, class R>
TURBIDITE_INLINE void add_turning_map(const Rows& row, PassSums<Rows::width>& sums,
                                      const Vector<R>& normal, const R& un, const Vector<R>& ut,
                                      const Vector<R>& w) {
    const R rn = load(row.rn), s = load(row.inverse_nn), size = load(row.length);
    const R one = R{} + 1.0, shorter = one / size;
    const Vector<R> rt = load(row.rx, row.ry, row.rz);
    const R slope[3] = {load(row.friction), load(row.rolling) * shorter,
                        load(row.torsion) * shorter};
    const Parts<R> spin = parts(size * w, normal);
    const Parts<R> moment = parts(shorter * load(row.mx, row.my, row.mz), normal);
    const Vector<R> t = rt - s * ut, roll = moment.across - s * spin.across;
    const Vector<R> twist = moment.along - s * spin.along;
    const R slip =
        slope[0] * length(ut) + slope[1] * length(spin.across) + slope[2] * length(spin.along);
    const R sizes[3] = {length(t), length(roll), length(twist)};
    const R on = nearest_normal(R(rn - s * (un + slip)), sizes, slope);
    const R fn = rn - on;
    const Vector<R> ft = rt - clipped(t, R(slope[0] * on));
    const Vector<R> fr = moment.across - clipped(roll, R(slope[1] * on));
    const Vector<R> fw = moment.along - clipped(twist, R(slope[2] * on));
    const R error = fn * fn + product(ft, ft) + product(fr, fr) + product(fw, fw);
    const R all = rn * rn + product(rt, rt) + product(moment.across, moment.across) +
                  product(moment.along, moment.along);
    store(sums.error, R(load(sums.error) + error));
    store(sums.size, R(load(sums.size) + all));
}

/// w_b - w_a + b_w; the spin of a wall is in b_w.
template <class Rows, class R>
TURBIDITE_INLINE Vector<R> relative_spin(const Rows& row, const Motion<R>& wa,
                                         const Motion<R>& wb) {
    return (wb.rate - wa.rate) + load(row.bias_wx, row.bias_wy, row.bias_wz);
}

/// The new moment at the relative spin w.
template <class Rows, class R>
TURBIDITE_INLINE Vector<R> next_moment(const Rows& row, const Vector<R>& normal, const R& n,
                                       const Vector<R>& w) {
    const Vector<R> old = load(row.mx, row.my, row.mz);
    // m - w/W_rr would stop the relative spin; each part is shortened to its limit.
    const Parts<R> wanted = parts(old - load(row.inverse_rr) * w, normal);
    return clipped(wanted.across, R(load(row.rolling) * n)) +
           clipped(wanted.along, R(load(row.torsion) * n));
}

/// The new moment, and its effect on the spins of the bodies.
template <class Rows, class R>
TURBIDITE_INLINE void turn(Rows& row, const Vector<R>& normal, const R& n, Motion<R>& wa,
                           Motion<R>& wb) {
    const Vector<R> moment = next_moment(row, normal, n, relative_spin(row, wa, wb));
    const Vector<R> change = moment - load(row.mx, row.my, row.mz);
    wa.rate = wa.rate - wa.inverse * change;
    wb.rate = wb.rate + wb.inverse * change;
    store(row.mx, moment.x), store(row.my, moment.y), store(row.mz, moment.z);
}

/// A normal impulse, and the part of it that the contact carries.
template <class R>
struct Normal {
    R impulse, contact;
};

/// The r_n of the contact alone, at the velocity u_n.
template <class Rows, class R>
TURBIDITE_INLINE Normal<R> solve_normal(const Rows& row, const R& rn, const R& un) {
    const R zero{};
    if constexpr (requires { row.film_cutoff; }) {
        const R offset = load(row.film_offset), q = load(row.film_q), a = load(row.film_a);
        // b = u_n - W_nn r_n, then a sigma^2 + (p - sigma_b) sigma - q = 0 (film.hpp). Of the two
        // forms of the root the one is taken that adds numbers of one sign.
        const R b = un - load(row.nn) * rn, free = b + offset;  // sigma_b
        const R p = load(row.film_p) - free;
        const R size = root(larger(R(p * p + 4.0 * a * q), zero));
        const R filmed = p >= zero ? 2.0 * q / (p + size) : (size - p) / (2.0 * a);
        const R sigma = free < load(row.film_cutoff) ? filmed : free;
        const R n = (larger(R(sigma - offset), zero) - b) * load(row.inverse_nn);
        const R carried = larger(R(n - load(row.film_closed)), zero);
        return {n, sigma < offset ? carried : zero};
    } else {
        const R n = larger(R(rn - un * load(row.inverse_nn)), zero);
        return {n, n};
    }
}

/// Adds |r - r*|^2 and |r|^2 (problem/space/filmed_contact.hpp); `next`, `t`: of r*.
template <class Rows, class R>
TURBIDITE_INLINE void add_filmed_map(const Rows& row, PassSums<Rows::width>& sums,
                                     const Vector<R>& normal, const Normal<R>& next,
                                     const Vector<R>& t, const Vector<R>& w) {
    const R one = R{} + 1.0, shorter = one / load(row.length), rn = load(row.rn);
    const Vector<R> rt = load(row.rx, row.ry, row.rz), moment = load(row.mx, row.my, row.mz);
    const Vector<R> held = next_moment(row, normal, next.contact, w);
    const R fn = rn - next.impulse;
    const Vector<R> ft = rt - t, fm = shorter * (moment - held), m = shorter * moment;
    store(sums.error, R(load(sums.error) + (fn * fn + product(ft, ft) + product(fm, fm))));
    store(sums.size, R(load(sums.size) + (rn * rn + product(rt, rt) + product(m, m))));
}

template <bool measure, class Rows>
TURBIDITE_INLINE void update(Rows& row, SphereBody* bodies, PassSums<Rows::width>& sums) {
    using R = Real<Rows::width>;
    const Vector<R> normal = load(row.nx, row.ny, row.nz);
    Motion<R> va = gather(bodies, row.a, velocity_of), vb = gather(bodies, row.b, velocity_of);
    Motion<R> wa = gather(bodies, row.a, spin_of), wb = gather(bodies, row.b, spin_of);
    const R arm_a = load(row.arm_a), arm_b = load(row.arm_b);
    const R rn = load(row.rn), mu = load(row.friction), inverse_nn = load(row.inverse_nn);
    const Vector<R> rt = load(row.rx, row.ry, row.rz);

    // With the arms l_a = r_a n and l_b = -r_b n:
    //    u = v_b - v_a - (r_a w_a + r_b w_b) x n + b
    const Vector<R> apart = vb.rate - va.rate;
    const R along = product(normal, apart);
    const R un = along + load(row.bias_n);
    Vector<R> ut = (apart - along * normal) - cross(arm_a * wa.rate + arm_b * wb.rate, normal);
    if constexpr (requires { row.bias_x; }) ut = ut + load(row.bias_x, row.bias_y, row.bias_z);
    constexpr bool turns = requires {
        row.mx;
    };
    constexpr bool filmed = requires {
        row.film_cutoff;
    };
    if constexpr (measure && turns && !filmed)
        add_turning_map(row, sums, normal, un, ut, relative_spin(row, wa, wb));
    if constexpr (measure && !turns) add_map(sums, rn, rt, un, ut, mu, inverse_nn);

    // r_n' = max(r_n - u_n/W_nn, 0), with a film the root of its equation;
    // r_t' = r_t - u_t/W_tt, shortened to mu times what the contact carries of r_n'
    const Normal<R> n = solve_normal(row, rn, un);
    const Vector<R> t = clipped(rt - load(row.inverse_tt) * ut, R(mu * n.contact));
    if constexpr (measure && filmed)
        add_filmed_map(row, sums, normal, n, t, relative_spin(row, wa, wb));
    if constexpr (measure) count_loaded(sums, n.impulse);

    // b: v += p/m, w += l_b x p/I;   a: v -= p/m, w -= l_a x p/I
    // l_a and l_b are opposite, so both spins change in the same sense.
    const Vector<R> dt = t - rt;
    const Vector<R> push = R(n.impulse - rn) * normal + dt, twist = cross(normal, dt);
    va.rate = va.rate - va.inverse * push;
    vb.rate = vb.rate + vb.inverse * push;
    wa.rate = wa.rate - R(wa.inverse * arm_a) * twist;
    wb.rate = wb.rate - R(wb.inverse * arm_b) * twist;
    if constexpr (turns) turn(row, normal, n.contact, wa, wb);
    store(row.rn, n.impulse);
    store(row.rx, t.x), store(row.ry, t.y), store(row.rz, t.z);
    scatter(bodies, row.a, velocity_of, va), scatter(bodies, row.a, spin_of, wa);
    scatter(bodies, row.b, velocity_of, vb), scatter(bodies, row.b, spin_of, wb);
}

/// Whether some contact of the group has an impulse, closes, or has a film that acts.
template <class Rows>
TURBIDITE_INLINE bool needs_update(const Rows& row, const SphereBody* bodies) {
    using R = Real<Rows::width>;
    const Motion<R> va = gather(bodies, row.a, velocity_of);
    const Motion<R> vb = gather(bodies, row.b, velocity_of);
    const R un = product(load(row.nx, row.ny, row.nz), vb.rate - va.rate) + load(row.bias_n);
    const R closing = -smaller(un, R{});
    if constexpr (requires { row.film_cutoff; }) {
        const R zero{}, reach = load(row.film_cutoff) - (un + load(row.film_offset));
        return any(larger(larger(magnitude(load(row.rn)), closing), larger(reach, zero)));
    }
    return any(larger(magnitude(load(row.rn)), closing));
}
