// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Packs one contact into a lane of a group (sphere_rows.hpp), as sweep_layout.hpp asks for it.
#pragma once

#include <array>
#include <concepts>
#include <type_traits>

#include "granular_adapter/nscd/problem/space/sphere_operator.hpp"
#include "granular_adapter/nscd/sweeps/space/sphere_rows.hpp"
#include "granular_adapter/nscd/sweeps/sweep_layout.hpp"

namespace turbidite::nscd {

using SphereToPack = ContactToPack<SpaceMobility, SphereBlock>;

template <class Rows>
concept SphereKind = std::derived_from<Rows, SphereRows<Rows::width>>;

template <int lanes>
void fill(SphereRows<lanes>& rows, int lane, const SphereToPack& packed);
template <int lanes>
void fill(BiasedSphereRows<lanes>& rows, int lane, const SphereToPack& packed);
template <int lanes>
void fill(TurningSphereRows<lanes>& rows, int lane, const SphereToPack& packed);

template <int lanes>
void fill(FilmSphereRows<lanes>& rows, int lane, const SphereToPack& packed);

/// The film's lanes; `nn`: W_nn.
template <int lanes>
void fill_film(FilmSphereRows<lanes>& rows, int lane, const Film& film, double nn);

/// A lane without a contact.
template <SphereKind Rows>
void fill_empty(Rows& rows, int lane, std::int32_t slot) {
    rows.a[lane] = rows.b[lane] = slot;
    rows.bias_n.v[lane] = 1.0;
    if constexpr (requires { rows.length; }) rows.length.v[lane] = 1.0;
    if constexpr (requires { rows.film_cutoff; }) fill_film(rows, lane, Film(), 1.0);
}

template <SphereKind Rows>
ContactVector impulse(const Rows& rows, int lane) {
    Contact contact;
    contact.normal = {rows.nx.v[lane], rows.ny.v[lane], rows.nz.v[lane]};
    contact.tangent = tangent_of(contact.normal);
    ContactVector r = in_frame(contact, {rows.rx.v[lane], rows.ry.v[lane], rows.rz.v[lane]});
    r.n = rows.rn.v[lane];
    return r;
}

template <int lanes>
Vec3 moment(const TurningSphereRows<lanes>& rows, int lane) {
    return {rows.mx.v[lane], rows.my.v[lane], rows.mz.v[lane]};
}

/// The impulses and moments of a group, for Momentum.
template <SphereKind Rows>
auto impulse_lanes(const Rows& rows) {
    if constexpr (requires { rows.mx; })
        return std::array{rows.rn, rows.rx, rows.ry, rows.rz, rows.mx, rows.my, rows.mz};
    else
        return std::array{rows.rn, rows.rx, rows.ry, rows.rz};
}
template <SphereKind Rows, class Impulses>
void set_impulse_lanes(Rows& rows, const Impulses& r) {
    rows.rn = r[0], rows.rx = r[1], rows.ry = r[2], rows.rz = r[3];
    if constexpr (requires { rows.mx; }) rows.mx = r[4], rows.my = r[5], rows.mz = r[6];
}

inline SphereBody packed_body(const Twist& v, const SpaceMobility& mobility) {
    return {v.velocity[0], v.velocity[1], v.velocity[2], mobility.linear,
            v.spin[0],     v.spin[1],     v.spin[2],     mobility.angular};
}

/// Velocity and spin as six doubles, for other ranks.
inline void copy_rates(const SphereBody& from, double* to) {
    to[0] = from.vx, to[1] = from.vy, to[2] = from.vz;
    to[3] = from.wx, to[4] = from.wy, to[5] = from.wz;
}
inline void set_rates(SphereBody& to, const double* from) {
    to.vx = from[0], to.vy = from[1], to.vz = from[2];
    to.wx = from[3], to.wy = from[4], to.wz = from[5];
}

/// The rows for the contacts of an operator.
template <class Use>
auto with_rows(const SphereOperator& w, const Use& use) {
    using std::type_identity;
    if (w.has_films()) return use(type_identity<FilmSphereRows<4>>());
    if (w.has_moments()) return use(type_identity<TurningSphereRows<4>>());
    return w.has_tangential_bias() ? use(type_identity<BiasedSphereRows<4>>())
                                   : use(type_identity<SphereRows<4>>());
}

}  // namespace turbidite::nscd
