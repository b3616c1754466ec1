// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What several keys must satisfy together. Each rule names the keys it reads and is tried only when
// all of them have a valid value.
#pragma once

#include <vector>

#include "coupler/keys/entries.hpp"
#include "coupler/keys/rule.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// Appends to entries.problems what is wrong with the value of a key.
void object(const std::string& key, const Objection& objection, const Settings& settings,
            CaseEntries& entries);

/// Problems are appended to entries.problems.
void check_rules(const Settings& settings, CaseEntries& entries);

/// Sentences for the user about a valid case, e.g. an end that is no whole number of windows, and
/// the keys of `entries` that have no effect in it.
std::vector<std::string> rule_notes(const Settings& settings, const CaseEntries& entries);

}  // namespace turbidite
