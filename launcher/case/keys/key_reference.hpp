// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The table of keys for the user: as Markdown (docs/case-reference.md) and for a terminal
// (`turbidite keys`). `names` are groups or keys, all if empty; throws Failure (bad_input) naming
// the one that does not exist.
#pragma once

#include <string>
#include <vector>

namespace turbidite {

std::string key_reference(const std::vector<std::string>& names = {});

/// In lines of at most `width` characters, but for words that are longer.
std::string key_help(const std::vector<std::string>& names, int width);

}  // namespace turbidite
