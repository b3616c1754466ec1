// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What molecular dynamics (grains.adapter: yade-md) asks of a case, and which keys mean nothing to
// it.
#pragma once

#include "launcher/case/case_rule.hpp"

namespace turbidite {

bool is_md(const Settings& settings);

const std::vector<Rule>& md_rules();

/// Keys that are set and have no effect, with and without molecular dynamics.
void add_md_notes(const Settings& settings, std::vector<std::string>& notes);

}  // namespace turbidite
