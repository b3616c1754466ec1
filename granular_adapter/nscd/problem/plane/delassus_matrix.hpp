// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The Delassus operator W = H^T M^-1 H (Topin 2011, Eq. 19), assembled in block compressed row
// storage: one 2x2 block (n, t) for every pair of contacts that share a movable body. [1/kg]
//
// Bitwise symmetric. Covers normal and tangent only, not rolling.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "granular_adapter/nscd/problem/contact_problem.hpp"
#include "granular_adapter/nscd/problem/plane/one_contact.hpp"

namespace turbidite::nscd {

/// Block W_kj by columns: the change of (u_n, u_t) at k caused by a unit impulse along n, then
/// along t, at contact j.
struct Coupling {
    Plane by_n{};
    Plane by_t{};
};

struct DelassusMatrix {
    std::vector<Block> diagonal;          ///< W_kk
    std::vector<std::int64_t> row_start;  ///< of block row k in the arrays below; one more entry
    std::vector<std::int32_t> column;     ///< block column j != k, ascending within a row
    std::vector<Coupling> coupling;       ///< W_kj

    explicit DelassusMatrix(const ContactProblem& problem);

    std::size_t size() const { return diagonal.size(); }
};

/// u = H^T v_free + b of every contact, (n, t) [m/s].
std::vector<Plane> free_contact_velocities(const ContactProblem& problem);

/// Whether any contact has rolling resistance, which (n, t) problems cannot express.
bool has_rolling(const ContactProblem& problem);

}  // namespace turbidite::nscd
