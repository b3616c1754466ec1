// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace turbidite {

/// Insertions, deletions, replacements and swaps of neighbours that turn one word into the other.
std::size_t edit_distance(const std::string& from, const std::string& to);

/// The closest of the known names; `friction` finds `contact.friction`.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

/// All that have `name` as a whole word (`yade`: `yade-nscd`, `yade-md`), at most three, otherwise
/// the closest one.
std::vector<std::string> nearest_names(const std::string& name,
                                       const std::vector<std::string>& known);

}  // namespace turbidite
