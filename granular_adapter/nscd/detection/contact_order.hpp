// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The order in which Gauss-Seidel visits contacts: from the top down, which carries weight and
// needs a third fewer sweeps than the order of detection.
//
// Contacts of one height (rows of a lattice) are taken colour by colour, so that no two neighbours
// follow each other: in a row from left to right each would wait for the one before, and groups of
// four (contact_schedule.hpp) stay two thirds empty.
#pragma once

#include <vector>

#include "granular_adapter/nscd/detection/contact_point.hpp"

namespace turbidite::nscd {

/// Sorts along gravity; without gravity contacts stay as they are. Heights within `band` of each
/// other [m] count as one. The result depends on the input only.
void order_top_down(std::vector<ContactPoint>& points, const Bodies& bodies, const Vec3& gravity,
                    double band);

}  // namespace turbidite::nscd
