// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace turbidite {

/// Insertions, deletions, replacements and swaps of neighbours that turn one word into the other.
std::size_t edit_distance(const std::string& from, const std::string& to);

/// The closest of the known names; `friction` finds `contact.friction`.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

/// What `name` may stand for: the known name that a typing error makes of it, otherwise those that
/// have it as a whole word (`yade`: `yade-nscd`, `yade-md`), at most three; empty if none is like
/// it.
std::vector<std::string> resembling(const std::string& name, const std::vector<std::string>& known);

/// "Did you mean yade-nscd or yade-md? REST", or the rest alone if none resembles it.
std::string did_you_mean(const std::string& name, const std::vector<std::string>& known,
                         const std::string& rest);

/// Those that resemble it, otherwise the closest one.
std::vector<std::string> nearest_names(const std::string& name,
                                       const std::vector<std::string>& known);

}  // namespace turbidite
