// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A rule over several keys of a case; lists of them are in case_rules.cpp, law_rules.cpp and
// md_rules.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// What is wrong with `key`, or nothing.
struct Objection {
    std::string allowed;
    std::string remedy;
};
using Verdict = std::optional<Objection>;

struct Rule {
    const char* key;                 ///< the one that is blamed
    std::vector<const char*> reads;  ///< the others
    Verdict (*check)(const Settings&);
};

}  // namespace turbidite
