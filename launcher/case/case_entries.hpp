// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A YAML document as a flat list of entries `contact.friction = 0.3` with the line each came from.
// Groups may be nested or written with points. Knows nothing of which keys exist.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "launcher/case/case_error.hpp"

namespace turbidite {

struct CaseEntry {
    std::string source;  ///< file name or "--set"
    int line = 0;        ///< 1-based; 0 for --set
    std::string key;
    std::string value;     ///< as written; lists as "[a, b]"
    bool is_null = false;  ///< nothing after the colon, or ~
    bool is_list = false;
    std::vector<std::string> items;  ///< of a list
};

struct CaseEntries {
    std::vector<CaseEntry> entries;
    std::vector<CaseProblem> problems;  ///< unreadable file, YAML syntax, keys given twice

    const CaseEntry* find(const std::string& key) const;
};

/// Entries of the file, with those of the overrides (`key=value`) in place of the file's.
CaseEntries read_case_entries(const std::filesystem::path& file,
                              const std::vector<std::string>& overrides);

}  // namespace turbidite
