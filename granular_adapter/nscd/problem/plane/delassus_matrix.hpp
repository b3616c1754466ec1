// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The assembled Delassus operator (coupled_rows.hpp) of contacts in the plane, in 2x2 blocks (n,
// t). [1/kg]
//
// Bitwise symmetric. Covers normal and tangent only, not rolling.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "granular_adapter/nscd/problem/coupled_rows.hpp"
#include "granular_adapter/nscd/problem/plane/one_contact.hpp"

namespace turbidite::nscd {

/// Block W_kj by columns: the change of (u_n, u_t) at k caused by a unit impulse along n, then
/// along t, at contact j.
struct Coupling {
    Plane by_n{};
    Plane by_t{};

    Coupling& operator+=(const Coupling& share);

    // For coupled_rows.
    using Mobility = PlanarTensor;

    /// Directions n and t as (x, y, spin) of the body, with the sign of the impulse on it.
    struct End {
        std::int32_t contact;
        std::array<PlanarVector, 2> direction;
    };

    static End end_of(const Contact& contact, std::int32_t index, bool at_b);
    static Coupling share(const PlanarTensor& body, const End& row, const End& column);
    static Coupling transposed(const Coupling& w);
};

struct DelassusMatrix : CoupledRows<Coupling> {
    std::vector<Block> diagonal;  ///< W_kk

    explicit DelassusMatrix(const ContactProblem& problem);

    std::size_t size() const { return diagonal.size(); }
};

}  // namespace turbidite::nscd
