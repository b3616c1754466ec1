// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The keys of the soft contacts of molecular dynamics.
#include "granular_adapter/contact_keys/contact_keys.hpp"

namespace turbidite {
namespace {

std::string beside_stiffness(const Settings& s) {
    return s.has("contact.md_stiffness") ? "beside contact.md_stiffness" : "";
}

}  // namespace

KeyGroup molecular_dynamics_keys() {
    return {
        .keys = {
            {.name = "contact.md_overlap",
             .type = KeyType::real,
             .unit = "D",
             .fallback = "0.001",
             .range = {.lower = 0.0, .upper = 0.1, .lower_open = true},
             .help = "molecular dynamics: overlap for which the stiffness is chosen",
             .contacts = Contacts::springs,
             .idle = beside_stiffness},
            {.name = "contact.md_speed",
             .type = KeyType::real,
             .unit = "u_c",
             .need = Need::optional,
             .range = positive,
             .help = "molecular dynamics: approach speed for which the stiffness is chosen; "
                     "default: 2 with a "
                     "fluid; without one, twice the speed of a fall from the top of the packing",
             .remedy = "Leave it out, or use for example 2.",
             .contacts = Contacts::springs,
             .idle = beside_stiffness},
            {.name = "contact.md_stiffness",
             .type = KeyType::real,
             .unit = "m g/D",
             .need = Need::optional,
             .range = positive,
             .help = "molecular dynamics: stiffness of two touching grains, m the mass that they "
                     "move with, cM in a fluid; default: from "
                     "contact.md_overlap, "
                     "contact.md_speed and the height of the packing",
             .remedy = "Leave it out, or use for example 1e5.",
             .contacts = Contacts::springs},
            {.name = "contact.md_substeps",
             .type = KeyType::real,
             .unit = "per contact time",
             .fallback = "20",
             .range = {.lower = 12.0, .upper = 1000.0},
             .help = "molecular dynamics: smallest number of sub-steps in the contact time of two "
                     "grains",
             .allowed = "Between 12, below which dense packings may become unstable, and 1000.",
             .remedy = "Use 20.",
             .contacts = Contacts::springs},
        }};
}

}  // namespace turbidite
