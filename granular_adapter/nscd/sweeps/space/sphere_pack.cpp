// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/sweeps/space/sphere_pack.hpp"

namespace turbidite::nscd {
namespace {

/// The tangential part as a vector in world axes.
Vec3 tangential_part(const Contact& contact, const ContactVector& x) {
    return x.t * contact.tangent + x.s * binormal_of(contact);
}

}  // namespace

template <int lanes>
void fill(SphereRows<lanes>& rows, int lane, const SphereToPack& packed) {
    const Contact& contact = packed.contact;
    const Vec3 tangential = tangential_part(contact, packed.r);
    rows.a[lane] = packed.slot_a;
    rows.b[lane] = packed.slot_b;
    rows.nx.v[lane] = contact.normal[0];
    rows.ny.v[lane] = contact.normal[1];
    rows.nz.v[lane] = contact.normal[2];
    rows.bias_n.v[lane] = contact.bias.n;
    rows.friction.v[lane] = contact.friction;
    rows.rn.v[lane] = packed.r.n;
    rows.rx.v[lane] = tangential[0];
    rows.ry.v[lane] = tangential[1];
    rows.rz.v[lane] = tangential[2];
    // l_a = r_a n, l_b = -r_b n: two positive lengths stand for the arms.
    rows.arm_a.v[lane] = dot(contact.arm_a, contact.normal);
    rows.arm_b.v[lane] = -dot(contact.arm_b, contact.normal);
    rows.inverse_nn.v[lane] = 1.0 / packed.w.nn;
    rows.inverse_tt.v[lane] = 1.0 / packed.w.tt;
}

template <int lanes>
void fill(BiasedSphereRows<lanes>& rows, int lane, const SphereToPack& packed) {
    fill(static_cast<SphereRows<lanes>&>(rows), lane, packed);
    const Vec3 bias = tangential_part(packed.contact, packed.contact.bias);
    rows.bias_x.v[lane] = bias[0];
    rows.bias_y.v[lane] = bias[1];
    rows.bias_z.v[lane] = bias[2];
}

template <int lanes>
void fill(TurningSphereRows<lanes>& rows, int lane, const SphereToPack& packed) {
    fill(static_cast<BiasedSphereRows<lanes>&>(rows), lane, packed);
    // Neither body can rotate: no moment has an effect, and limits of zero leave it at zero.
    const bool rotates = packed.w.rr > 0.0;
    rows.rolling.v[lane] = rotates ? packed.contact.rolling : 0.0;
    rows.torsion.v[lane] = rotates ? packed.contact.torsion : 0.0;
    rows.mx.v[lane] = packed.moment[0];
    rows.my.v[lane] = packed.moment[1];
    rows.mz.v[lane] = packed.moment[2];
    rows.bias_wx.v[lane] = packed.contact.spin_bias[0];
    rows.bias_wy.v[lane] = packed.contact.spin_bias[1];
    rows.bias_wz.v[lane] = packed.contact.spin_bias[2];
    rows.inverse_rr.v[lane] = rotates ? 1.0 / packed.w.rr : 0.0;
    rows.length.v[lane] = rotates ? turning_length(packed.w) : 1.0;
}

template <int lanes>
void fill_film(FilmSphereRows<lanes>& rows, int lane, const Film& film, double nn) {
    // Coefficients of the quadratic (film.hpp), constant in a solve.
    const FilmEquation equation(film, nn);
    rows.nn.v[lane] = nn;
    rows.film_a.v[lane] = equation.a;
    rows.film_p.v[lane] = equation.p;
    rows.film_q.v[lane] = equation.q;
    rows.film_cutoff.v[lane] = film.cutoff;
    rows.film_offset.v[lane] = film.offset;
    rows.film_closed.v[lane] = film.closed();
}

template <int lanes>
void fill(FilmSphereRows<lanes>& rows, int lane, const SphereToPack& packed) {
    fill(static_cast<TurningSphereRows<lanes>&>(rows), lane, packed);
    fill_film(rows, lane, *packed.w.film, packed.w.nn);
}

template void fill_film(FilmSphereRows<4>&, int, const Film&, double);
template void fill_film(FilmSphereRows<1>&, int, const Film&, double);
template void fill(FilmSphereRows<4>&, int, const SphereToPack&);
template void fill(FilmSphereRows<1>&, int, const SphereToPack&);
template void fill(SphereRows<4>&, int, const SphereToPack&);
template void fill(SphereRows<1>&, int, const SphereToPack&);
template void fill(BiasedSphereRows<4>&, int, const SphereToPack&);
template void fill(BiasedSphereRows<1>&, int, const SphereToPack&);
template void fill(TurningSphereRows<4>&, int, const SphereToPack&);
template void fill(TurningSphereRows<1>&, int, const SphereToPack&);

}  // namespace turbidite::nscd
