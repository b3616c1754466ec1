// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The names of contact laws and solvers with a one-line description of each, for programs that
// offer the choice but do not compute: this needs no numerics, and the engine need not be linked.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace turbidite::nscd {

/// The slots of a contact law, in the order in which their parts are applied.
enum class LawSlot { gap, friction, adhesion, film, impact, rolling };
inline constexpr std::size_t law_slots = 6;

/// "gap", "friction", …
std::string slot_name(LawSlot slot);

struct NamedChoice {
    std::string name;
    std::string description;
};

/// Choices of one slot, in the order of law_table.def.
std::vector<NamedChoice> law_choices(LawSlot slot);

/// Choices of solver, in the order of solver_table.def.
std::vector<NamedChoice> solver_choices();

}  // namespace turbidite::nscd
