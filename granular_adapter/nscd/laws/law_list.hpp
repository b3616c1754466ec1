// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Every part of a contact law, by slot and name: the lines of names/law_table.def.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "granular_adapter/nscd/laws/law.hpp"

namespace turbidite::nscd {

/// None if the part has no effect on any pair of these surfaces. Throws std::invalid_argument
/// naming the parameter that is missing or out of range.
using MakeLaw = std::optional<LawPart>(const LawSettings&, const SurfaceTable&);

#define TURBIDITE_LAW(slot, name, description, make) MakeLaw make;
#include "granular_adapter/nscd/names/law_table.def"
#undef TURBIDITE_LAW

struct LawEntry {
    LawSlot slot;
    std::string name;
    std::string description;
    MakeLaw* make;

    /// True for the name that stands for no part.
    bool adds_nothing() const { return make == make_nothing; }
};

/// The table in which names are looked up; a caller with laws of its own passes a longer one.
using LawList = std::span<const LawEntry>;
LawList law_list();

/// As MakeLaw; throws std::invalid_argument listing the known names of the slot for any other.
std::optional<LawPart> make_law_part(LawSlot slot, const std::string& name,
                                     const LawSettings& settings, const SurfaceTable& surfaces,
                                     LawList laws = law_list());

}  // namespace turbidite::nscd
