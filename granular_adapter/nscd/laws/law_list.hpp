// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Every part of a contact law there is, by slot and name. A new one: one file pair, one line in
// law_list.cpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "granular_adapter/nscd/laws/law.hpp"

namespace turbidite::nscd {

struct LawEntry {
    LawSlot slot;
    std::string name;
    std::string description;
    /// nullptr: the name means that nothing is added.
    std::unique_ptr<const LawPart> (*make)(const LawSettings&, const SurfaceTable&);
};
const std::vector<LawEntry>& law_list();

/// "gap", "friction", …
std::string slot_name(LawSlot slot);

/// Null where the name stands for nothing. Throws std::invalid_argument that lists the known names
/// of the slot, or names the parameter that is missing or out of range.
std::unique_ptr<const LawPart> make_law_part(LawSlot slot, const std::string& name,
                                             const LawSettings& settings,
                                             const SurfaceTable& surfaces);

}  // namespace turbidite::nscd
