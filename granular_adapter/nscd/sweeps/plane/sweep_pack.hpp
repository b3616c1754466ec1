// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Packs one contact into a lane of a group (sweep_rows.hpp).
#pragma once

#include <cstddef>
#include <cstring>

#include "granular_adapter/nscd/problem/contact_problem.hpp"
#include "granular_adapter/nscd/sweeps/plane/sweep_rows.hpp"

namespace turbidite::nscd {

/// A contact with the data to be packed; an immovable body has zero mobility.
struct PackedContact {
    const Contact& contact;
    const Block& w;
    BodyMobility a, b;
    ContactVector r;
    std::int32_t slot_a, slot_b;
};

template <int lanes>
void fill(DiscRows<lanes>& rows, int lane, const PackedContact& packed);
template <int lanes>
void fill(RollingDiscRows<lanes>& rows, int lane, const PackedContact& packed);
template <int lanes>
void fill(GeneralRows<lanes>& rows, int lane, const PackedContact& packed);
void fill(GeneralRollingRows<1>& rows, int lane, const PackedContact& packed);

/// A lane without a contact.
template <class Rows>
void fill_empty(Rows& rows, int lane, std::int32_t slot) {
    rows.a[lane] = rows.b[lane] = slot;
    rows.bias_n.v[lane] = 1.0;
    if constexpr (requires { rows.length.v; }) rows.length.v[lane] = 1.0;
}

/// Copies a lane: all members of Rows are lanes of doubles, apart from the body slots.
template <class Rows>
void copy_lane(const Rows& from, int lane_from, Rows& to, int lane_to) {
    using Base = RowBase<Rows::width>;
    constexpr std::size_t size = sizeof(typename Base::Values), value = sizeof(double);
    constexpr std::size_t places = offsetof(Base, a);
    static_assert(sizeof(Rows) % size == 0 && places % size == 0 && 2 * sizeof(Base::a) == size);
    const auto* const source = reinterpret_cast<const std::byte*>(&from) + value * lane_from;
    auto* const target = reinterpret_cast<std::byte*>(&to) + value * lane_to;
    for (std::size_t at = 0; at < sizeof(Rows); at += size)
        if (at != places) std::memcpy(target + at, source + at, value);
    to.a[lane_to] = from.a[lane_from];
    to.b[lane_to] = from.b[lane_from];
}

template <class Rows>
ContactVector impulse(const Rows& rows, int lane) {
    ContactVector r = in_plane(rows.rn.v[lane], rows.rt.v[lane]);
    if constexpr (requires { rows.roll.v; })
        r.roll = rows.roll.v[lane];
    else if constexpr (requires { rows.roll; })
        r.roll = rows.roll;
    return r;
}

}  // namespace turbidite::nscd
