// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Packs one contact into a lane of a group (sweep_rows.hpp), as sweep_layout.hpp asks for it.
#pragma once

#include <array>
#include <concepts>
#include <type_traits>

#include "granular_adapter/nscd/problem/plane/delassus.hpp"
#include "granular_adapter/nscd/sweeps/plane/sweep_rows.hpp"
#include "granular_adapter/nscd/sweeps/sweep_layout.hpp"

namespace turbidite::nscd {

using PackedContact = ContactToPack<PlanarTensor, Block>;

template <int lanes>
void fill(DiscRows<lanes>& rows, int lane, const PackedContact& packed);
template <int lanes>
void fill(RollingDiscRows<lanes>& rows, int lane, const PackedContact& packed);
template <int lanes>
void fill(GeneralRows<lanes>& rows, int lane, const PackedContact& packed);
void fill(AnyRows<1>& rows, int lane, const PackedContact& packed);

template <class Rows>
concept PlaneRows = std::derived_from<Rows, RowBase<Rows::width>>;

/// A lane without a contact.
template <PlaneRows Rows>
void fill_empty(Rows& rows, int lane, std::int32_t slot) {
    rows.a[lane] = rows.b[lane] = slot;
    rows.bias_n.v[lane] = 1.0;
    if constexpr (requires { rows.length.v; }) rows.length.v[lane] = 1.0;
}

template <PlaneRows Rows>
ContactVector impulse(const Rows& rows, int lane) {
    ContactVector r = in_plane(rows.rn.v[lane], rows.rt.v[lane]);
    if constexpr (requires { rows.roll.v; })
        r.roll = rows.roll.v[lane];
    else if constexpr (requires { rows.roll; })
        r.roll = rows.roll;
    return r;
}

/// The impulses and moments of a group, for Momentum.
template <PlaneRows Rows>
auto impulse_lanes(const Rows& rows) {
    if constexpr (requires { rows.roll.v; })
        return std::array{rows.rn, rows.rt, rows.roll};
    else if constexpr (requires { rows.roll; })
        return std::array{rows.rn, rows.rt, Lanes<1>{{rows.roll}}};
    else
        return std::array{rows.rn, rows.rt};
}
template <PlaneRows Rows, class Impulses>
void set_impulse_lanes(Rows& rows, const Impulses& r) {
    rows.rn = r[0], rows.rt = r[1];
    if constexpr (requires { rows.roll.v; })
        rows.roll = r[2];
    else if constexpr (requires { rows.roll; })
        rows.roll = r[2].v[0];
}

inline PlaneBody packed_body(const Twist& v, const PlanarTensor& mobility) {
    return {v.velocity[0], v.velocity[1], v.spin[2], mobility.xx};
}

/// Velocity and spin as six doubles, for other ranks: in the places of a Twist.
inline void copy_rates(const PlaneBody& from, double* to) {
    to[0] = from.x, to[1] = from.y, to[5] = from.spin;
    to[2] = to[3] = to[4] = 0.0;
}
inline void set_rates(PlaneBody& to, const double* from) {
    to.x = from[0], to.y = from[1], to.spin = from[5];
}

/// The rows for the contacts of an operator.
template <class Use>
auto with_rows(const Delassus& w, const Use& use) {
    using std::type_identity;
    if (w.filmed()) return use(type_identity<AnyRows<1>>());
    if (w.diagonal())
        return w.rolling() ? use(type_identity<RollingDiscRows<4>>())
                           : use(type_identity<DiscRows<4>>());
    return w.rolling() ? use(type_identity<AnyRows<1>>()) : use(type_identity<GeneralRows<4>>());
}

}  // namespace turbidite::nscd
