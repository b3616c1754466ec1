// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/law_list.hpp"

#include <stdexcept>
#include <vector>

namespace turbidite::nscd {

std::optional<LawPart> make_nothing(const LawSettings&, const SurfaceTable&) {
    return std::nullopt;
}

LawList law_list() {
    static const std::vector<LawEntry> laws = {
#define TURBIDITE_LAW(slot, name, description, make) {LawSlot::slot, name, description, make},
#include "granular_adapter/nscd/names/law_table.def"
#undef TURBIDITE_LAW
    };
    return laws;
}

std::optional<LawPart> make_law_part(LawSlot slot, const std::string& name,
                                     const LawSettings& settings, const SurfaceTable& surfaces,
                                     LawList laws) {
    std::string known;
    for (const LawEntry& entry : laws) {
        if (entry.slot != slot) continue;
        if (entry.name == name) return entry.make(settings, surfaces);
        known += (known.empty() ? "" : ", ") + entry.name;
    }
    throw std::invalid_argument("unknown contact law \"" + name + "\" (" + slot_name(slot) +
                                "); known: " + known);
}

}  // namespace turbidite::nscd
