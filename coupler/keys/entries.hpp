// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The values given for keys, with their origin: lines of a case file, arguments of --set, options
// of a script. Independent of which keys exist.
#pragma once

#include <string>
#include <vector>

#include "coupler/keys/case_error.hpp"

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
    CaseProblems problems;  ///< of reading them

    const CaseEntry* find(const std::string& key) const;
};

}  // namespace turbidite
