// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/law_list.hpp"

#include <stdexcept>

#include "granular_adapter/nscd/coulomb.hpp"

namespace turbidite::nscd {
namespace {

template <class Law>
std::unique_ptr<const ContactLaw> make(const LawSettings& settings) {
    return std::make_unique<Law>(settings);
}

}  // namespace

const std::vector<LawEntry>& law_list() {
    static const std::vector<LawEntry> laws = {
        {"coulomb", "dry friction, no restitution", make<Coulomb>},
    };
    return laws;
}

std::unique_ptr<const ContactLaw> make_law(const std::string& name, const LawSettings& settings) {
    std::string known;
    for (const LawEntry& entry : law_list()) {
        if (entry.name == name) return entry.make(settings);
        known += (known.empty() ? "" : ", ") + entry.name;
    }
    throw std::invalid_argument("unknown contact law \"" + name + "\"; known: " + known);
}

}  // namespace turbidite::nscd
