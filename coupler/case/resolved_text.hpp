// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The resolved case as YAML: every key in the order of the table, with its unit, and a fingerprint
// of the grains. Equal cases give equal text; it loads to itself.
#pragma once

#include <string>

#include "coupler/case/packing.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

std::string resolved_text(const Settings& settings, const Packing& grains);

}  // namespace turbidite
