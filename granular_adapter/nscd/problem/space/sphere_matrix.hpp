// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The assembled Delassus operator (coupled_rows.hpp) of contacts of spheres, in 3x3 blocks (n, t,
// s) of the contacts' frames. [1/kg]
//
// The engine needs no such matrix (sphere_operator.hpp): it is for other codes, and assumes nothing
// about the directions of arms. Bitwise symmetric, blocks on the diagonal included. Covers forces
// only, no moments.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "granular_adapter/nscd/problem/coupled_rows.hpp"
#include "granular_adapter/nscd/problem/space/mobility.hpp"

namespace turbidite::nscd {

/// Block W_kj: entry [3 j + i] is the change of component i of u at k caused by a unit impulse
/// along component j at the other contact.
struct SphereCoupling {
    std::array<double, 9> entry{};

    SphereCoupling& operator+=(const SphereCoupling& share);

    // For coupled_rows.
    using Mobility = SpaceMobility;

    /// A unit impulse along n, t and s, with its sign on this body, and its moment about the
    /// centre.
    struct End {
        std::int32_t contact;
        std::array<Vec3, 3> force, moment;
    };

    static End end_of(const Contact& contact, std::int32_t index, bool at_b);
    static SphereCoupling share(const SpaceMobility& body, const End& row, const End& column);
    static SphereCoupling transposed(const SphereCoupling& w);
};

struct SphereMatrix : CoupledRows<SphereCoupling> {
    std::vector<SphereCoupling> diagonal;  ///< W_kk

    /// Of a problem of space.
    explicit SphereMatrix(const ContactProblem& problem);

    std::size_t size() const { return diagonal.size(); }
};

}  // namespace turbidite::nscd
