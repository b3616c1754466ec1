// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How fluid and grains exchange within a window.
#include "coupler/hub/schemes/scheme.hpp"
#include "launcher/case/keys/key_groups.hpp"

namespace turbidite {
namespace {

/// The schemes of hub/schemes with a fluid, and one that stands for them.
std::vector<Choice> scheme_choices() {
    std::vector<Choice> choices = {
        {"auto", "joint with contact dynamics, split with springs and with programs of your own"}};
    for (const SchemeEntry& scheme : scheme_list())
        if (!scheme.fluid.empty()) choices.push_back({scheme.name, scheme.help});
    return choices;
}

std::string without_rounds(const Settings& s) {
    if (const std::string dry = without_fluid(s); !dry.empty()) return dry;
    const SchemeEntry& scheme = find_scheme(s.text("coupling.scheme"));
    return scheme.has_rounds() ? "" : std::string("with coupling.scheme: ") + scheme.name;
}
std::string idle_positions(const Settings& s) {
    if (const std::string dry = without_fluid(s); !dry.empty()) return dry;
    const SchemeEntry& scheme = find_scheme(s.text("coupling.scheme"));
    if (!scheme.needs_inertia()) return "";
    return std::string("with coupling.scheme: ") + scheme.name +
           ", where grains move with the contact velocity";
}

}  // namespace

KeyGroup coupling_keys() {
    return {
        .keys = {
            {.name = "coupling.scheme",
             .type = KeyType::choice,
             .fallback = "auto",
             .choices = scheme_choices(),
             .help = "order of the exchange",
             .idle = without_fluid},
            {.name = "coupling.recording",
             .type = KeyType::choice,
             .fallback = "none",
             .choices = {{"none", "messages are not kept"},
                         {"grains", "those of the grains"},
                         {"fluid", "those of the fluid"},
                         {"both", "of both: some kilobytes per grain and window"}},
             .help = "messages kept in recording/, for turbidite replay"},
            {.name = "coupling.positions",
             .type = KeyType::choice,
             .fallback = "corrected",
             .choices = {{"corrected", "grains move with the fluid-corrected velocity"},
                         {"contact", "grains move with the velocity the contacts allow"}},
             .help = "velocity with which grains move (split; under joint always contact)",
             .contacts = Contacts::rigid,
             .idle = idle_positions},
            {.name = "coupling.md_hold",
             .type = KeyType::flag,
             .fallback = "true",
             .help = "molecular dynamics: the hydrodynamic impulse of the last window acts in the "
                     "sub-steps",
             .contacts = Contacts::springs,
             .idle = without_fluid},
            {.name = "coupling.tolerance",
             .type = KeyType::real,
             .unit = "u_c",
             .fallback = "0.0001",
             .range = open_unit_interval,
             .help =
                 "joint, sub-iterated: largest difference between contact and fluid velocity of a "
                 "grain",
             .idle = without_rounds},
            {.name = "coupling.iterations",
             .type = KeyType::integer,
             .fallback = "10",
             .range = {.lower = 1.0},
             .help =
                 "joint, sub-iterated: largest number of contact solves per window; windows that "
                 "need more "
                 "are counted",
             .idle = without_rounds},
        }};
}

}  // namespace turbidite
