// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The materials of a case: "default", which has the coefficients of contact.*, and those that
// contact.materials names.
#pragma once

#include <string>
#include <vector>

#include "coupler/keys/entries.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// "default", then the others by name; a grain's material is an index of it.
std::vector<std::string> material_names(const Settings& settings);

/// Pairs of materials that are not there, coefficients that do not fit together, an adapter that
/// has one material. Problems are appended to entries.problems.
void check_materials(const Settings& settings, CaseEntries& entries);

}  // namespace turbidite
