// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Rules that several keys must satisfy together. Each rule names the keys it reads and is checked
// only if all of them have a valid value.
#pragma once

#include <vector>

#include "coupler/keys/entries.hpp"
#include "coupler/keys/rule.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// The problem with the value of a key, at the line that gives it.
CaseProblem problem_with(const std::string& key, const Objection& objection,
                         const Settings& settings, const CaseEntries& entries);

/// Whether the case must fit into this machine. One that another machine plays or has played, or
/// whose mesh is not needed, need not.
enum class Machine { any, this_one };

CaseProblems check_rules(const Settings& settings, const CaseEntries& entries, Machine machine);

/// Notes for the user about a valid case, e.g. an end that is not a whole number of windows, and
/// the keys of `entries` that have no effect.
std::vector<std::string> rule_notes(const Settings& settings, const CaseEntries& entries);

}  // namespace turbidite
