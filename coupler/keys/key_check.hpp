// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Checks entries against a table of keys: known, of the right type, in range, available. Valid
// values go into Settings, with defaults for the keys not given; the others become problems.
#pragma once

#include "coupler/keys/entries.hpp"
#include "coupler/keys/key_spec.hpp"

namespace turbidite {

struct CheckedKeys {
    Settings settings;  ///< without the keys that were refused
    CaseProblems problems;
};
CheckedKeys check_keys(const KeyTable& table, const CaseEntries& entries);

}  // namespace turbidite
