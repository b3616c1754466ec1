// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the keys of contact laws must satisfy together.
#pragma once

#include "launcher/case/case_rule.hpp"

namespace turbidite {

const std::vector<Rule>& law_rules();

/// Sentences about keys of laws that were not chosen, and about laws that may make energy.
void add_law_notes(const Settings& settings, std::vector<std::string>& notes);

}  // namespace turbidite
