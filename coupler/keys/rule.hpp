// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A rule over several keys of a case, defined in the same file as the group of these keys.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupler/keys/key_spec.hpp"

namespace turbidite {

/// What is wrong with `key`, or nothing.
struct Objection {
    std::string allowed;
    std::string remedy;
};
using Ruling = std::optional<Objection>;

struct Rule {
    const char* key;                 ///< the key named in the error
    std::vector<const char*> reads;  ///< the others
    Ruling (*check)(const Settings&);
    bool of_machine = false;  ///< asks what the machine that plays the case has
};

/// Keys, what they must satisfy together, and sentences for the user about a valid case.
struct KeyGroup {
    KeyTable keys;
    std::vector<Rule> rules = {};
    void (*notes)(const Settings&, std::vector<std::string>&) = nullptr;
};

}  // namespace turbidite
