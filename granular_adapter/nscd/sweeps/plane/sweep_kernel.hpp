// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The update of a group of contacts in the plane (sweep_rows.hpp). This file is included once per
// instruction set, between lane_kernel.hpp and sweep_loops.hpp.
//
//     u = H_k^T v + b_k,   r_k' = exact solution of the contact alone,   v += M^-1 H_k (r_k' - r_k)

template <class R>
struct BodyValues {
    R x, y, spin, inverse_mass;
};

TURBIDITE_INLINE Four body_at(const PlaneBody* bodies, std::int32_t at) {
    Four value;
    __builtin_memcpy(&value, __builtin_assume_aligned(bodies + at, 32), sizeof value);
    return value;
}

TURBIDITE_INLINE void put(PlaneBody* bodies, std::int32_t at, const Four& value) {
    __builtin_memcpy(__builtin_assume_aligned(bodies + at, 32), &value, sizeof value);
}

TURBIDITE_INLINE BodyValues<Four> gather(const PlaneBody* bodies, const std::int32_t (&at)[4]) {
    const Four b0 = body_at(bodies, at[0]), b1 = body_at(bodies, at[1]);
    const Four b2 = body_at(bodies, at[2]), b3 = body_at(bodies, at[3]);
    const Four xs01 = __builtin_shufflevector(b0, b1, 0, 4, 2, 6);
    const Four ym01 = __builtin_shufflevector(b0, b1, 1, 5, 3, 7);
    const Four xs23 = __builtin_shufflevector(b2, b3, 0, 4, 2, 6);
    const Four ym23 = __builtin_shufflevector(b2, b3, 1, 5, 3, 7);
    return {__builtin_shufflevector(xs01, xs23, 0, 1, 4, 5),
            __builtin_shufflevector(ym01, ym23, 0, 1, 4, 5),
            __builtin_shufflevector(xs01, xs23, 2, 3, 6, 7),
            __builtin_shufflevector(ym01, ym23, 2, 3, 6, 7)};
}

TURBIDITE_INLINE void scatter(PlaneBody* bodies, const std::int32_t (&at)[4],
                              const BodyValues<Four>& v) {
    const Four xy02 = __builtin_shufflevector(v.x, v.y, 0, 4, 2, 6);
    const Four xy13 = __builtin_shufflevector(v.x, v.y, 1, 5, 3, 7);
    const Four sm02 = __builtin_shufflevector(v.spin, v.inverse_mass, 0, 4, 2, 6);
    const Four sm13 = __builtin_shufflevector(v.spin, v.inverse_mass, 1, 5, 3, 7);
    put(bodies, at[0], __builtin_shufflevector(xy02, sm02, 0, 1, 4, 5));
    put(bodies, at[1], __builtin_shufflevector(xy13, sm13, 0, 1, 4, 5));
    put(bodies, at[2], __builtin_shufflevector(xy02, sm02, 2, 3, 6, 7));
    put(bodies, at[3], __builtin_shufflevector(xy13, sm13, 2, 3, 6, 7));
}

TURBIDITE_INLINE BodyValues<double> gather(const PlaneBody* bodies, const std::int32_t (&at)[1]) {
    const PlaneBody& body = bodies[at[0]];
    return {body.x, body.y, body.spin, body.inverse_mass};
}

TURBIDITE_INLINE void scatter(PlaneBody* bodies, const std::int32_t (&at)[1],
                              const BodyValues<double>& v) {
    bodies[at[0]] = {v.x, v.y, v.spin, v.inverse_mass};
}

/// Adds |natural map|^2 (rolling_contact.hpp; in the plane without moments) and |r|^2.
template <int width, class R>
TURBIDITE_INLINE void add_map(PassSums<width>& sums, const R& rn, const R& rt, const R& un,
                              const R& ut, const R& mu, const R& rho) {
    const R one = R{} + 1.0;
    // r - rho (u + (mu |u_t|, 0))
    const R n = rn - rho * (un + mu * magnitude(ut)), t = rt - rho * ut;
    const R slid = (n + mu * magnitude(t)) / (one + mu * mu);  // projection on the edge of the cone
    const R on = larger(larger(n, slid), R{});
    const R fn = rn - on, ft = rt - clamped(t, R(mu * on));  // r - P_K(...)
    store(sums.error, R(load(sums.error) + (fn * fn + ft * ft)));
    store(sums.size, R(load(sums.size) + (rn * rn + rt * rt)));
}

/// The state of a group before its update: velocities of its bodies, impulses, friction.
template <class Rows>
struct Met {
    using R = Real<Rows::width>;
    BodyValues<R> a, b;
    R nx, ny, dx, dy, rn, rt, mu;

    TURBIDITE_INLINE Met(const Rows& row, const PlaneBody* bodies)
        : a(gather(bodies, row.a)),
          b(gather(bodies, row.b)),
          nx(load(row.nx)),
          ny(load(row.ny)),
          dx(b.x - a.x),
          dy(b.y - a.y),
          rn(load(row.rn)),
          rt(load(row.rt)),
          mu(load(row.friction)) {}

    TURBIDITE_INLINE void keep(Rows& row, const R& n, const R& t, PlaneBody* bodies) const {
        store(row.rn, n);
        store(row.rt, t);
        scatter(bodies, row.a, a);
        scatter(bodies, row.b, b);
    }
};

template <class Rows>
TURBIDITE_INLINE Real<Rows::width> normal_velocity(const Rows& row, const Met<Rows>& met) {
    // u_n = n . (v_b - v_a) + (arm_b x n) w_b - (arm_a x n) w_a + b_n; without the arms where they
    // are along n
    const Real<Rows::width> along = met.nx * met.dx + met.ny * met.dy;
    if constexpr (requires { row.arm_bn; })
        return along + load(row.arm_bn) * met.b.spin - load(row.arm_an) * met.a.spin +
               load(row.bias_n);
    else
        return along + load(row.bias_n);
}

template <class Rows, class R>
TURBIDITE_INLINE R tangential_velocity(const Rows& row, const Met<Rows>& met) {
    return met.nx * met.dy - met.ny * met.dx + load(row.arm_b) * met.b.spin -
           load(row.arm_a) * met.a.spin + load(row.bias_t);
}

/// v += M^-1 H d for bodies with isotropic mobility; d = (dn, dt) along n and t.
template <class Rows, class R>
TURBIDITE_INLINE void push(const Rows& row, Met<Rows>& met, const R& dn, const R& dt) {
    // p = dn n + dt t with t = (-n_y, n_x): v += p/m, w += (arm x t) dt/I on b, the opposite on a
    const R px = met.nx * dn - met.ny * dt, py = met.ny * dn + met.nx * dt;
    met.a.x -= met.a.inverse_mass * px;
    met.a.y -= met.a.inverse_mass * py;
    met.b.x += met.b.inverse_mass * px;
    met.b.y += met.b.inverse_mass * py;
    met.a.spin -= load(row.turn_a) * dt;
    met.b.spin += load(row.turn_b) * dt;
}

/// Exact solution: with W_nt = 0 the normal impulse does not depend on the tangential one, and
/// friction is a clamp.
template <bool measure, int width>
TURBIDITE_INLINE void update(DiscRows<width>& row, PlaneBody* bodies, PassSums<width>& sums) {
    using R = Real<width>;
    Met<DiscRows<width>> met(row, bodies);
    const R un = normal_velocity(row, met);
    const R ut = tangential_velocity<DiscRows<width>, R>(row, met);
    if constexpr (measure) add_map(sums, met.rn, met.rt, un, ut, met.mu, load(row.inverse_nn));
    // r_n' = max(r_n - u_n/W_nn, 0)
    const R n = larger(R(met.rn - un * load(row.inverse_nn)), R{});
    // r_t' = clamp(r_t - u_t/W_tt, mu r_n')
    const R t = clamped(R(met.rt - ut * load(row.inverse_tt)), R(met.mu * n));
    if constexpr (measure) count_loaded(sums, n);
    push(row, met, R(n - met.rn), R(t - met.rt));
    met.keep(row, n, t, bodies);
}

/// The same as add_map with the rolling moment.
template <int width, class R>
TURBIDITE_INLINE void add_rolling_map(const RollingDiscRows<width>& row, PassSums<width>& sums,
                                      const Met<RollingDiscRows<width>>& met, const R& un,
                                      const R& ut, const R& w) {
    const R one = R{} + 1.0, s = load(row.inverse_nn), mu = met.mu;
    const R length = load(row.length), lever = load(row.rolling), lean = lever / length;
    const R moment = load(row.roll) / length;
    const R xn = met.rn - s * (un + mu * magnitude(ut) + lever * magnitude(w));
    const R xt = met.rt - s * ut, xm = moment - s * (w * length);
    const R t = mu * magnitude(xt), m = lean * magnitude(xm);
    const R both = (xn + t + m) / (one + mu * mu + lean * lean);
    const R single = larger(R((xn + t) / (one + mu * mu)), R((xn + m) / (one + lean * lean)));
    const R on = larger(larger(larger(xn, single), both), R{});
    const R fn = met.rn - on, ft = met.rt - clamped(xt, R(mu * on));
    const R fm = moment - clamped(xm, R(lean * on));
    store(sums.error, R(load(sums.error) + (fn * fn + ft * ft + fm * fm)));
    store(sums.size, R(load(sums.size) + (met.rn * met.rn + met.rt * met.rt + moment * moment)));
}

/// Exact solution: the normal impulse first, then solve_on_box() of rolling_contact.hpp.
template <bool measure, int width>
TURBIDITE_INLINE void update(RollingDiscRows<width>& row, PlaneBody* bodies,
                             PassSums<width>& sums) {
    using R = Real<width>;
    Met<RollingDiscRows<width>> met(row, bodies);
    const R un = normal_velocity(row, met);
    const R ut = tangential_velocity<RollingDiscRows<width>, R>(row, met);
    const R w = met.b.spin - met.a.spin + load(row.bias_roll), roll = load(row.roll);
    if constexpr (measure) add_rolling_map(row, sums, met, un, ut, w);
    const R n = larger(R(met.rn - un * load(row.inverse_nn)), R{});
    const R tr = load(row.tr), limit_m = load(row.rolling) * n;
    const R bt = ut - load(row.tt) * met.rt - tr * roll;  // b = u - W r
    const R br = w - tr * met.rt - load(row.rr) * roll;
    const R held = magnitude(tr) * limit_m, inverse_tt = load(row.inverse_tt);
    const R low = -(bt + held) * inverse_tt, high = -(bt - held) * inverse_tt;
    const R free = -(bt - tr * br * load(row.inverse_rr)) * load(row.inverse_a);  // zero of g_0
    // r_t': zero of max(g_-, min(g_+, g_0)), clamped
    const R t = clamped(smaller(larger(free, low), high), R(met.mu * n));
    const R m = clamped(R(-(br + tr * t) * load(row.inverse_rr)), limit_m);
    if constexpr (measure) count_loaded(sums, n);
    push(row, met, R(n - met.rn), R(t - met.rt));
    met.a.spin -= load(row.spin_a) * (m - roll);
    met.b.spin += load(row.spin_b) * (m - roll);
    store(row.roll, m);
    met.keep(row, n, t, bodies);
}

template <class Rows>
TURBIDITE_INLINE Real<Rows::width> general_tangential_velocity(const Rows& row,
                                                               const Met<Rows>& met) {
    return met.nx * met.dy - met.ny * met.dx + load(row.arm_bt) * met.b.spin -
           load(row.arm_at) * met.a.spin + load(row.bias_t);
}

template <class Rows, class R>
TURBIDITE_INLINE void general_push(const Rows& row, Met<Rows>& met, const R& dn, const R& dt) {
    met.a.x -= load(row.a_nx) * dn + load(row.a_tx) * dt;
    met.a.y -= load(row.a_ny) * dn + load(row.a_ty) * dt;
    met.a.spin -= load(row.a_ns) * dn + load(row.a_ts) * dt;
    met.b.x += load(row.b_nx) * dn + load(row.b_tx) * dt;
    met.b.y += load(row.b_ny) * dn + load(row.b_ty) * dt;
    met.b.spin += load(row.b_ns) * dn + load(row.b_ts) * dt;
}

/// solve_contact() of one_contact.hpp: evaluates both branches and selects.
template <bool measure, int width>
TURBIDITE_INLINE void update(GeneralRows<width>& row, PlaneBody* bodies, PassSums<width>& sums) {
    using R = Real<width>;
    Met<GeneralRows<width>> met(row, bodies);
    const R un = normal_velocity(row, met), ut = general_tangential_velocity(row, met);
    const R nt = load(row.nt), inverse_nn = load(row.inverse_nn);
    if constexpr (measure) add_map(sums, met.rn, met.rt, un, ut, met.mu, inverse_nn);
    const R bn = un - load(row.nn) * met.rn - nt * met.rt;  // b = u - W r
    const R bt = ut - nt * met.rn - load(row.tt) * met.rt;
    const R trial = -(bt - nt * bn * inverse_nn) * load(row.inverse_a);  // r_t = -c/A
    const R held = -(bn + nt * trial) * inverse_nn;                      // r_n of the stick trial
    const R zero{}, minus = -met.mu;
    const R inverse = trial < zero ? load(row.inverse_backward) : load(row.inverse_forward);
    const R side = trial < zero ? minus : met.mu;
    const R slid = -bn * inverse;  // -b_n/(W_nn + s mu W_nt)
    const auto sticks = magnitude(trial) <= met.mu * held;
    const R closed_n = sticks ? held : slid, closed_t = sticks ? trial : R(side * slid);
    const R n = bn < zero ? closed_n : zero, t = bn < zero ? closed_t : zero;
    if constexpr (measure) count_loaded(sums, n);
    general_push(row, met, R(n - met.rn), R(t - met.rt));
    met.keep(row, n, t, bodies);
}

template <bool measure>
TURBIDITE_INLINE void update(AnyRows<1>& row, PlaneBody* bodies, PassSums<1>& sums) {
    Met<AnyRows<1>> met(row, bodies);
    const ContactVector r = in_plane(met.rn, met.rt, row.roll);
    const ContactVector u =
        in_plane(normal_velocity(row, met), general_tangential_velocity(row, met),
                 met.b.spin - met.a.spin + row.bias_roll);
    const Block& w = row.w;
    const ContactVector b = in_plane(u.n - w.nn * r.n - w.nt * r.t - w.nr * r.roll,
                                     u.t - w.nt * r.n - w.tt * r.t - w.tr * r.roll,
                                     u.roll - w.nr * r.n - w.tr * r.t - w.rr * r.roll);
    const ContactVector next = w.film ? solve_filmed_contact(w, b, met.mu, row.rolling)
                                      : without_film(w, b, met.mu, row.rolling);
    if constexpr (measure) {
        // The natural map; with a film, which is no cone, the change of the contact alone.
        const ContactVector f =
            w.film
                ? in_plane(r.n - next.n, r.t - next.t, (r.roll - next.roll) / row.length)
                : rolling_natural_map(r, u, met.mu, row.rolling, load(row.inverse_nn), row.length);
        const double moment = row.roll / row.length;
        sums.error.v[0] += f.n * f.n + f.t * f.t + f.roll * f.roll;
        sums.size.v[0] += r.n * r.n + r.t * r.t + moment * moment;
        count_loaded(sums, next.n);
    }
    general_push(row, met, next.n - r.n, next.t - r.t);
    const double dm = next.roll - r.roll;
    met.a.x -= row.a_rx * dm, met.a.y -= row.a_ry * dm, met.a.spin -= row.a_rs * dm;
    met.b.x += row.b_rx * dm, met.b.y += row.b_ry * dm, met.b.spin += row.b_rs * dm;
    row.roll = next.roll;
    met.keep(row, next.n, next.t, bodies);
}

/// Whether some contact of the group has an impulse, closes, or has a film that acts.
template <class Rows>
TURBIDITE_INLINE bool needs_update(const Rows& row, const PlaneBody* bodies) {
    const Met<Rows> met(row, bodies);
    const Real<Rows::width> un = normal_velocity(row, met), zero{};
    if constexpr (requires { row.w.film; })
        if (row.w.film && (met.rn != 0.0 || row.w.film->acts(un))) return true;
    return any(larger(magnitude(met.rn), Real<Rows::width>(-smaller(un, zero))));
}
