// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/sweeps/plane/sweep_pack.hpp"

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/problem/plane/rolling_contact.hpp"

namespace turbidite::nscd {
namespace {

template <int lanes>
void fill_base(RowBase<lanes>& rows, int lane, const PackedContact& packed) {
    const Contact& contact = packed.contact;
    rows.a[lane] = packed.slot_a;
    rows.b[lane] = packed.slot_b;
    rows.nx.v[lane] = contact.normal[0];
    rows.ny.v[lane] = contact.normal[1];
    rows.bias_n.v[lane] = contact.bias.n;
    rows.bias_t.v[lane] = contact.bias.t;
    rows.friction.v[lane] = contact.friction;
    rows.rn.v[lane] = packed.r.n;
    rows.rt.v[lane] = packed.r.t;
}

/// M^-1 (d, arm x d): change of velocity by a unit impulse along d.
PlanarVector answer(const BodyMobility& body, double x, double y, double arm) {
    return body * PlanarVector{x, y, arm};
}

/// The lever of rolling resistance; zero if neither body can rotate (W_rr = 0).
double lever(const PackedContact& packed) {
    return packed.w.rr > 0.0 ? packed.contact.rolling : 0.0;
}

}  // namespace

template <int lanes>
void fill(DiscRows<lanes>& rows, int lane, const PackedContact& packed) {
    fill_base(rows, lane, packed);
    const Contact& contact = packed.contact;
    // Arms are along n: r_n turns no body, and r_t changes the spin by (arm x t) r_t/I.
    rows.arm_a.v[lane] = cross_z(contact.arm_a, contact.tangent);
    rows.arm_b.v[lane] = cross_z(contact.arm_b, contact.tangent);
    rows.turn_a.v[lane] = packed.a.ss * rows.arm_a.v[lane];
    rows.turn_b.v[lane] = packed.b.ss * rows.arm_b.v[lane];
    rows.inverse_nn.v[lane] = 1.0 / packed.w.nn;
    rows.inverse_tt.v[lane] = 1.0 / packed.w.tt;
}

template <int lanes>
void fill(RollingDiscRows<lanes>& rows, int lane, const PackedContact& packed) {
    fill(static_cast<DiscRows<lanes>&>(rows), lane, packed);
    const Block& w = packed.w;
    // W_rr = 1/I_a + 1/I_b is zero where neither body can rotate: then there is no moment.
    const double inverse_rr = w.rr > 0.0 ? 1.0 / w.rr : 0.0;
    rows.rolling.v[lane] = lever(packed);
    rows.roll.v[lane] = packed.r.roll;
    rows.bias_roll.v[lane] = packed.contact.bias.roll;
    rows.spin_a.v[lane] = packed.a.ss;
    rows.spin_b.v[lane] = packed.b.ss;
    rows.tt.v[lane] = w.tt;
    rows.tr.v[lane] = w.tr;
    rows.rr.v[lane] = w.rr;
    // A = W_tt - W_tr^2/W_rr: the response along t while the moment keeps the spins equal.
    rows.inverse_a.v[lane] = 1.0 / (w.tt - w.tr * w.tr * inverse_rr);
    rows.inverse_rr.v[lane] = inverse_rr;
    rows.length.v[lane] = w.rr > 0.0 ? rolling_length(w) : 1.0;
}

template <int lanes>
void fill(GeneralRows<lanes>& rows, int lane, const PackedContact& packed) {
    fill_base(rows, lane, packed);
    const Contact& contact = packed.contact;
    const Block& w = packed.w;
    const double x = contact.normal[0], y = contact.normal[1];
    const double arm_an = cross_z(contact.arm_a, contact.normal);
    const double arm_at = cross_z(contact.arm_a, contact.tangent);
    const double arm_bn = cross_z(contact.arm_b, contact.normal);
    const double arm_bt = cross_z(contact.arm_b, contact.tangent);
    rows.arm_an.v[lane] = arm_an, rows.arm_at.v[lane] = arm_at;
    rows.arm_bn.v[lane] = arm_bn, rows.arm_bt.v[lane] = arm_bt;
    // t = e_z x n = (-n_y, n_x)
    const PlanarVector an = answer(packed.a, x, y, arm_an), at = answer(packed.a, -y, x, arm_at);
    const PlanarVector bn = answer(packed.b, x, y, arm_bn), bt = answer(packed.b, -y, x, arm_bt);
    rows.a_nx.v[lane] = an.x, rows.a_ny.v[lane] = an.y, rows.a_ns.v[lane] = an.spin;
    rows.a_tx.v[lane] = at.x, rows.a_ty.v[lane] = at.y, rows.a_ts.v[lane] = at.spin;
    rows.b_nx.v[lane] = bn.x, rows.b_ny.v[lane] = bn.y, rows.b_ns.v[lane] = bn.spin;
    rows.b_tx.v[lane] = bt.x, rows.b_ty.v[lane] = bt.y, rows.b_ts.v[lane] = bt.spin;
    rows.nn.v[lane] = w.nn, rows.nt.v[lane] = w.nt, rows.tt.v[lane] = w.tt;
    rows.inverse_nn.v[lane] = 1.0 / w.nn;
    // A = W_tt - W_nt^2/W_nn of the stick trial, and W_nn + s mu W_nt of sliding (one_contact.hpp).
    rows.inverse_a.v[lane] = 1.0 / (w.tt - w.nt * w.nt / w.nn);
    rows.inverse_forward.v[lane] = 1.0 / (w.nn + contact.friction * w.nt);
    rows.inverse_backward.v[lane] = 1.0 / (w.nn - contact.friction * w.nt);
}

void fill(AnyRows<1>& rows, int lane, const PackedContact& packed) {
    fill(static_cast<GeneralRows<1>&>(rows), lane, packed);
    const PlanarVector a = answer(packed.a, 0.0, 0.0, 1.0), b = answer(packed.b, 0.0, 0.0, 1.0);
    rows.a_rx = a.x, rows.a_ry = a.y, rows.a_rs = a.spin;
    rows.b_rx = b.x, rows.b_ry = b.y, rows.b_rs = b.spin;
    rows.rolling = lever(packed);
    rows.roll = packed.r.roll;
    rows.bias_roll = packed.contact.bias.roll;
    rows.length = packed.w.rr > 0.0 ? rolling_length(packed.w) : 1.0;
    rows.w = packed.w;
}

template void fill(DiscRows<4>&, int, const PackedContact&);
template void fill(DiscRows<1>&, int, const PackedContact&);
template void fill(RollingDiscRows<4>&, int, const PackedContact&);
template void fill(RollingDiscRows<1>&, int, const PackedContact&);
template void fill(GeneralRows<4>&, int, const PackedContact&);
template void fill(GeneralRows<1>&, int, const PackedContact&);

}  // namespace turbidite::nscd
