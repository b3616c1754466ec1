// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The names of contact laws and solvers with a line on each, for those who offer the choice and do
// not compute: no numerics are behind this, the engine need not be linked.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace turbidite::nscd {

/// What the parts of a law decide, in the order in which they do.
enum class LawSlot { gap, friction, adhesion, impact, rolling };
inline constexpr std::size_t law_slots = 5;

/// "gap", "friction", …
std::string slot_name(LawSlot slot);

struct NamedChoice {
    std::string name;
    std::string description;
};

/// Of one slot, in the order of law_table.def.
std::vector<NamedChoice> law_choices(LawSlot slot);

/// In the order of solver_table.def.
std::vector<NamedChoice> solver_choices();

}  // namespace turbidite::nscd
