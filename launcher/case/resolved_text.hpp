// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The resolved case as YAML: every key in the order of the table, with its unit, and a fingerprint
// of the grains, of the walls inside the box, of grains.script and of fluid.functions. Equal cases
// give equal text, and loading it gives the same case.
#pragma once

#include <string>

#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// How the text begins; a case that somebody writes does not.
inline constexpr const char* resolved_head = "# Resolved case:";

/// What stands in the files that a case names; all but the grains may be empty.
struct NamedTexts {
    const std::string &grains, &walls, &script, &functions;
};

std::string resolved_text(const Settings& settings, std::size_t grains, const NamedTexts& texts);

}  // namespace turbidite
