// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The materials of a case: "default", which has the coefficients of contact.*, and those defined by
// contact.materials.
#pragma once

#include <string>
#include <vector>

#include "coupler/keys/entries.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// "default", then the others by name; a grain's material is an index into this list.
std::vector<std::string> material_names(const Settings& settings);

/// Checks for pairs of unknown materials, inconsistent coefficients, and adapters with a single
/// material.
CaseProblems check_materials(const Settings& settings, const CaseEntries& entries);

}  // namespace turbidite
