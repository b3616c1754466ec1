// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The table of keys as a JSON Schema (draft 2020-12), with which editors complete and check case
// files while they are written. Rules between keys are those of `turbidite check` alone.
#pragma once

#include <string>

namespace turbidite {

std::string key_schema();

}  // namespace turbidite
