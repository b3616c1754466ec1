// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Every part of a contact law there is, by slot and name: the lines of names/law_table.def.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "granular_adapter/nscd/laws/law.hpp"

namespace turbidite::nscd {

/// Throws std::invalid_argument naming the parameter that is missing or out of range.
using MakeLaw = std::unique_ptr<const LawPart>(const LawSettings&, const SurfaceTable&);

#define TURBIDITE_LAW(slot, name, description, make) MakeLaw make;
#include "granular_adapter/nscd/names/law_table.def"
#undef TURBIDITE_LAW

struct LawEntry {
    LawSlot slot;
    std::string name;
    std::string description;
    MakeLaw* make;

    /// The name means that nothing is added: make() gives null.
    bool adds_nothing() const { return make == make_nothing; }
};

/// What a name is looked up in; whoever brings laws of its own hands over a longer one.
using LawList = std::span<const LawEntry>;
LawList law_list();

/// Null where the name stands for nothing. Throws std::invalid_argument that lists the known names
/// of the slot, or names the parameter that is missing or out of range.
std::unique_ptr<const LawPart> make_law_part(LawSlot slot, const std::string& name,
                                             const LawSettings& settings,
                                             const SurfaceTable& surfaces,
                                             LawList laws = law_list());

}  // namespace turbidite::nscd
