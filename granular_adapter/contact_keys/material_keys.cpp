// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The keys of further materials and of pairs of materials. A material takes what it does not
// specify from contact.*; a pair takes the smaller value of both, unless it specifies its own.
#include "coupler/keys/key_value.hpp"
#include "granular_adapter/contact_keys/contact_keys.hpp"

namespace turbidite {
namespace {

struct Coefficient {
    const char* name;
    const char* unit;
    Range range;
    const char* help;
    bool in_space_only = false;
};

constexpr Range unit_interval{.lower = 0.0, .upper = 1.0};
const Coefficient coefficients[] = {
    {"friction", "", not_negative, "friction coefficient"},
    {"static_friction", "", not_negative, "static friction coefficient (law static-dynamic)"},
    {"restitution", "", unit_interval, "restitution"},
    {"restitution_tangential", "", unit_interval, "tangential restitution"},
    {"rolling_friction", "", not_negative, "rolling resistance"},
    {"torsion_friction", "", not_negative, "torsional resistance", true},
    {"adhesion_force", "m g", not_negative,
     "force that separates two touching grains of diameter D"},
};

KeyTable keys_of(const std::string& group, const std::string& whose) {
    KeyTable table;
    for (const Coefficient& c : coefficients) {
        KeySpec key{.name = group + "." + c.name,
                    .type = KeyType::real,
                    .unit = c.unit,
                    .need = Need::optional,
                    .range = c.range,
                    .help = c.help + std::string(" of ") + whose};
        table.push_back(c.in_space_only ? of_space(key) : key);
    }
    return table;
}

}  // namespace

KeyGroup material_keys() {
    KeyTable table = keys_of("contact.materials.NAME", "the material NAME (column material)");
    for (KeySpec& key : keys_of("contact.pairs.FIRST-SECOND",
                                "two materials; the first material is called default"))
        table.push_back(std::move(key));
    return {.keys = std::move(table)};
}

std::string positive_coefficient(const Settings& settings, const std::string& coefficient) {
    const std::string ending = "." + coefficient;
    for (const auto& [key, value] : settings.entries()) {
        const bool of_contacts = key.rfind("contact.", 0) == 0;
        const bool ends_so = key.size() > ending.size() &&
                             key.compare(key.size() - ending.size(), ending.size(), ending) == 0;
        if (of_contacts && ends_so && parse_real(value).value_or(0.0) > 0.0) return key;
    }
    return "";
}

}  // namespace turbidite
