// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What every law that pulls demands of its parameters.
#pragma once

#include <string>

#include "granular_adapter/nscd/laws/law.hpp"

namespace turbidite::nscd {

/// Throws std::invalid_argument naming the law and the parameter unless the value is positive.
void demand_positive(const std::string& law, const std::string& parameter, double value);

/// Range and reference diameter positive, and at least one pair of surfaces that adheres.
void demand_adhesion(const std::string& law, const LawSettings& settings,
                     const SurfaceTable& surfaces);

}  // namespace turbidite::nscd
