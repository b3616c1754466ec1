// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What several keys must satisfy together. Each rule names the keys it reads and is tried only when
// all of them have a valid value.
#pragma once

#include <vector>

#include "coupler/protocol/settings.hpp"
#include "launcher/case/case_entries.hpp"

namespace turbidite {

/// Problems are appended to entries.problems.
void check_rules(const Settings& settings, CaseEntries& entries);

/// Sentences for the user about a valid case, e.g. an end that is no whole number of windows.
std::vector<std::string> rule_notes(const Settings& settings);

}  // namespace turbidite
