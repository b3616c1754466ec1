// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A YAML document as a flat list of entries `contact.friction = 0.3`, each with its line. Groups
// may be nested or written with points.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/keys/entries.hpp"

namespace turbidite {

/// Entries of a text, which messages call `source`.
CaseEntries case_entries_of(const std::string& text, const std::string& source);

/// Entries of an argument of --set, `key=value` with the value in YAML, which may be a group.
CaseEntries entries_of_override(const std::string& text);

/// `key=value` for entries_of_override of a text, whatever it contains.
std::string quoted_override(const std::string& key, const std::string& text);

/// Entries of the file, replaced by those of the overrides (`key=value`).
CaseEntries read_case_entries(const std::filesystem::path& file,
                              const std::vector<std::string>& overrides);

}  // namespace turbidite
