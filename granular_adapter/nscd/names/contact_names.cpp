// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/names/contact_names.hpp"

namespace turbidite::nscd {

std::string slot_name(LawSlot slot) {
    static const char* const names[law_slots] = {"gap",  "friction", "adhesion",
                                                 "film", "impact",   "rolling"};
    return names[static_cast<std::size_t>(slot)];
}

std::vector<NamedChoice> law_choices(LawSlot slot) {
    std::vector<NamedChoice> choices;
#define TURBIDITE_LAW(its_slot, name, description, make) \
    if (slot == LawSlot::its_slot) choices.push_back({name, description});
#include "granular_adapter/nscd/names/law_table.def"
#undef TURBIDITE_LAW
    return choices;
}

std::vector<NamedChoice> solver_choices() {
    return {
#define TURBIDITE_SOLVER(name, description, make) {name, description},
#include "granular_adapter/nscd/names/solver_table.def"
#undef TURBIDITE_SOLVER
    };
}

}  // namespace turbidite::nscd
