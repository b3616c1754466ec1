// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Parameter checks shared by all attractive laws.
#pragma once

#include <string>

#include "granular_adapter/nscd/laws/law.hpp"

namespace turbidite::nscd {

/// Throws std::invalid_argument naming the law and the parameter unless the value is positive.
void demand_positive(const std::string& law, const std::string& parameter, double value);

/// Requires a positive range and reference diameter, and at least one adhesive pair of surfaces.
void demand_adhesion(const std::string& law, const LawSettings& settings,
                     const SurfaceTable& surfaces);

}  // namespace turbidite::nscd
