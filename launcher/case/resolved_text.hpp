// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The resolved case as YAML: every key in the order of the table, with its unit, and a fingerprint
// of the grains, of the walls inside the box and of grains.script. Equal cases give equal text, and
// loading it gives the same case.
#pragma once

#include <string>

#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// `walls_csv` and `script` (text of grains.script) are empty if there are none.
std::string resolved_text(const Settings& settings, std::size_t grains,
                          const std::string& grains_csv, const std::string& walls_csv,
                          const std::string& script);

}  // namespace turbidite
