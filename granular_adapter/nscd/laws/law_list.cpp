// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/law_list.hpp"

#include <stdexcept>

#include "granular_adapter/nscd/laws/capillary.hpp"
#include "granular_adapter/nscd/laws/cohesion.hpp"
#include "granular_adapter/nscd/laws/coulomb.hpp"
#include "granular_adapter/nscd/laws/moreau.hpp"
#include "granular_adapter/nscd/laws/newton.hpp"
#include "granular_adapter/nscd/laws/rolling_resistance.hpp"
#include "granular_adapter/nscd/laws/signorini.hpp"
#include "granular_adapter/nscd/laws/static_dynamic.hpp"
#include "granular_adapter/nscd/laws/wet.hpp"

namespace turbidite::nscd {
namespace {

template <class Part>
std::unique_ptr<const LawPart> make(const LawSettings& settings, const SurfaceTable& surfaces) {
    return std::make_unique<Part>(settings, surfaces);
}

}  // namespace

const std::vector<LawEntry>& law_list() {
    using enum LawSlot;
    static const std::vector<LawEntry> laws = {
        {gap, "signorini", "no overlap; what there is is taken back slowly", make<Signorini>},
        {friction, "coulomb", "dry friction, one coefficient", make<Coulomb>},
        {friction, "static-dynamic", "contacts that stick hold more", make<StaticDynamic>},
        {adhesion, "none", "nothing pulls", nullptr},
        {adhesion, "cohesion", "bonds of the first step, broken for ever", make<Cohesion>},
        {adhesion, "wet", "constant pull within a distance", make<Wet>},
        {adhesion, "wet-irreversible", "the same, lost beyond the distance", make<WetOnce>},
        {adhesion, "capillary", "liquid bridges that form on contact", make<Capillary>},
        {impact, "newton", "normal and tangential restitution", make<Newton>},
        {impact, "moreau", "restitution of the averaged velocity", make<Moreau>},
        {rolling, "resistance", "a moment up to a lever times r_n", make<RollingResistance>},
    };
    return laws;
}

std::string slot_name(LawSlot slot) {
    static const char* const names[law_slots] = {"gap", "friction", "adhesion", "impact",
                                                 "rolling"};
    return names[static_cast<std::size_t>(slot)];
}

std::unique_ptr<const LawPart> make_law_part(LawSlot slot, const std::string& name,
                                             const LawSettings& settings,
                                             const SurfaceTable& surfaces) {
    std::string known;
    for (const LawEntry& entry : law_list()) {
        if (entry.slot != slot) continue;
        if (entry.name == name) return entry.make ? entry.make(settings, surfaces) : nullptr;
        known += (known.empty() ? "" : ", ") + entry.name;
    }
    throw std::invalid_argument("unknown contact law \"" + name + "\" (" + slot_name(slot) +
                                "); known: " + known);
}

}  // namespace turbidite::nscd
