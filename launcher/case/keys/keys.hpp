// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Every key of a case file, registered once (keys/, granular_adapter/contact_keys). Parser,
// validator, `turbidite keys`, the reference (docs/case-reference.md) and the resolved case use
// this table.
#pragma once

#include <string>
#include <vector>

#include "coupler/keys/rule.hpp"

namespace turbidite {

const std::vector<KeyGroup>& key_groups();

/// The keys of all groups; keys with the same prefix are consecutive.
const KeyTable& key_table();

/// nullptr if there is no such key.
const KeySpec* find_key(const std::string& name);

}  // namespace turbidite
