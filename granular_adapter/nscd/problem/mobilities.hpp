// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The mobilities of a problem's bodies, all of one kind of contact (contact_kind.hpp). The list of
// kinds: the general code visits it and names none of them.
#pragma once

#include <variant>
#include <vector>

#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/plane/mobility.hpp"
#include "granular_adapter/nscd/problem/space/mobility.hpp"

namespace turbidite::nscd {

/// M^-1 of every body.
using Mobilities = std::variant<std::vector<PlanarTensor>, std::vector<SpaceMobility>>;

/// From masses, moments of inertia and flags; in the plane (2) or of spheres in space (3).
Mobilities mobilities_of(const Bodies& bodies, int dimension);

inline int dimension(const Mobilities& mobilities) {
    return std::holds_alternative<std::vector<SpaceMobility>>(mobilities) ? 3 : 2;
}

inline std::size_t size(const Mobilities& mobilities) {
    return std::visit([](const auto& bodies) { return bodies.size(); }, mobilities);
}

inline void resize(Mobilities& mobilities, std::size_t size) {
    std::visit([size](auto& bodies) { bodies.resize(size); }, mobilities);
}

}  // namespace turbidite::nscd
