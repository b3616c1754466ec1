// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The keys of contact laws. Forces are in weights of one grain, m g with the density of the grains:
// the same physical force with and without a fluid.
#include "granular_adapter/contact_keys/contact_keys.hpp"

#include <fmt/format.h>

#include "granular_adapter/contact_keys/offered_choices.hpp"

namespace turbidite {
namespace {

bool adheres(const Settings& s) {
    return s.has("contact.adhesion") && !is(s, "contact.adhesion", "none");
}

Ruling sliding_holds_less(const Settings& s) {
    if (s.real("contact.static_friction") >= s.real("contact.friction")) return std::nullopt;
    return Objection{
        fmt::format(
            "The static coefficient must be at least the sliding one, contact.friction = {}.",
            s.text("contact.friction")),
        "Increase it."};
}

Ruling moreau_has_one_restitution(const Settings& s) {
    const std::string key = positive_coefficient(s, "restitution_tangential");
    if (s.text("contact.impact") != "moreau" || key.empty()) return std::nullopt;
    return Objection{fmt::format("With contact.impact: moreau, one restitution applies to both "
                                 "directions, but {} = {}.",
                                 key, s.text(key)),
                     fmt::format("Remove {}, or use contact.impact: newton.", key)};
}

Ruling only_discs_resist_rolling(const Settings& s) {
    return shape_is_round(s) ? std::nullopt : corners_do_not_roll(s);
}

Ruling range_of_neighbours(const Settings& s) {
    if (s.text("contact.adhesion") == "none") return std::nullopt;
    if (s.real("contact.adhesion_range") <= 1.0) return std::nullopt;
    return Objection{"Adhesion acts between neighbours: its range is at most 1 D.",
                     "Use a smaller range."};
}

std::string without_static_friction(const Settings& s) {
    return is(s, "contact.law", "static-dynamic") ? "" : "without contact.law: static-dynamic";
}
std::string without_adhesion(const Settings& s) {
    return adheres(s) ? "" : "without contact.adhesion";
}
std::string without_bridges(const Settings& s) {
    return is(s, "contact.adhesion", "capillary") ? "" : "without contact.adhesion: capillary";
}
std::string without_bonds(const Settings& s) {
    return is(s, "contact.adhesion", "cohesion") ? "" : "without contact.adhesion: cohesion";
}
/// Covers the restitution of every material and pair as well.
std::string without_restitution(const Settings& s) {
    for (const char* coefficient : {"restitution", "restitution_tangential"})
        if (!positive_coefficient(s, coefficient).empty()) return "";
    return "without a restitution";
}

}  // namespace

bool shape_is_round(const Settings& s) {
    return is(s, "grains.shape", "disc") || is(s, "grains.shape", "sphere");
}

bool has_films(const Settings& s) {
    return s.flag("fluid.enabled") && s.text("contact.film") != "none";
}

Ruling corners_have_no_films(const Settings& s) {
    if (!has_films(s)) return std::nullopt;
    return Objection{fmt::format("Films of liquid are between round grains only, but contact.film "
                                 "= {}.",
                                 s.text("contact.film")),
                     "Use none, or round grains."};
}

Ruling corners_do_not_roll(const Settings& s) {
    const std::string key = positive_coefficient(s, "rolling_friction");
    if (key.empty()) return std::nullopt;
    return Objection{
        fmt::format("Rolling resistance is for round grains, but {} = {}: polygons need none, "
                    "since their faces resist rolling.",
                    key, s.text(key)),
        "Use 0, or round grains."};
}

KeyGroup contact_law_keys() {
    return {
        .keys =
            {
                {.name = "contact.law",
                 .type = KeyType::choice,
                 .fallback = "coulomb",
                 .choices = offered(nscd::law_choices(nscd::LawSlot::friction)),
                 .help = "friction law"},
                {.name = "contact.static_friction",
                 .type = KeyType::real,
                 .need = Need::conditional,
                 .range = not_negative,
                 .help = "friction coefficient of sticking contacts, at least contact.friction",
                 .remedy = "Write for example static_friction: 0.5.",
                 .when = "contact.law: static-dynamic",
                 .required =
                     [](const Settings& s) { return is(s, "contact.law", "static-dynamic"); },
                 .idle = without_static_friction},
                {.name = "contact.impact",
                 .type = KeyType::choice,
                 .fallback = "newton",
                 .choices = offered(nscd::law_choices(nscd::LawSlot::impact)),
                 .help = "impact law; without restitution both are equivalent",
                 .contacts = Contacts::rigid},
                {.name = "contact.restitution",
                 .type = KeyType::real,
                 .fallback = "0",
                 .range = {.lower = 0.0, .upper = 1.0},
                 .help = "e: separation velocity of an impact over its approach velocity",
                 .allowed = "A restitution lies between 0 (no rebound) and 1 (no loss).",
                 .remedy = "Use 0 for grains that do not bounce."},
                {.name = "contact.restitution_tangential",
                 .type = KeyType::real,
                 .fallback = "0",
                 .range = {.lower = 0.0, .upper = 1.0},
                 .help = "tangential restitution (impact newton)",
                 .allowed = "A restitution lies between 0 and 1.",
                 .remedy = "Use 0.",
                 .contacts = Contacts::rigid},
                {.name = "contact.restitution_speed",
                 .type = KeyType::real,
                 .unit = "u_c",
                 .fallback = "0.001",
                 .range = not_negative,
                 .help = "contacts that approach more slowly than this do not rebound",
                 .contacts = Contacts::rigid,
                 .idle = without_restitution},
                {.name = "contact.rolling_friction",
                 .type = KeyType::real,
                 .fallback = "0",
                 .range = not_negative,
                 .help =
                     "rolling resistance over R r_n: the slope up to which a disc does not roll",
                 .allowed = "A coefficient of rolling resistance must be zero or positive.",
                 .remedy = "Use 0 for grains that roll freely."},
                of_space({.name = "contact.torsion_friction",
                          .type = KeyType::real,
                          .fallback = "0",
                          .range = not_negative,
                          .help = "resistance to a spin about the normal, over R r_n, as "
                                  "contact.rolling_friction to rolling"}),
                {.name = "contact.adhesion",
                 .type = KeyType::choice,
                 .fallback = "none",
                 .choices = offered(nscd::law_choices(nscd::LawSlot::adhesion)),
                 .help = "adhesion law"},
                {.name = "contact.adhesion_force",
                 .type = KeyType::real,
                 .unit = "m g",
                 .need = Need::conditional,
                 .range = positive,
                 .help = "force that separates two touching grains of diameter D",
                 .remedy = "Write for example adhesion_force: 1.",
                 .when = "contact.adhesion",
                 .required = adheres,
                 .idle = without_adhesion},
                {.name = "contact.adhesion_range",
                 .type = KeyType::real,
                 .unit = "D",
                 .need = Need::conditional,
                 .range = positive,
                 .help = "largest gap at which adhesion acts; cohesion: largest gap at which bonds "
                         "form in the first window",
                 .remedy = "Write for example adhesion_range: 0.05; for cohesion 0.001.",
                 .when = "contact.adhesion",
                 .required = adheres,
                 .idle = without_adhesion},
                {.name = "contact.adhesion_length",
                 .type = KeyType::real,
                 .unit = "D",
                 .need = Need::conditional,
                 .range = positive,
                 .help = "length over which the force of a liquid bridge decays with the gap",
                 .remedy = "Write for example adhesion_length: 0.02.",
                 .when = "contact.adhesion: capillary",
                 .required =
                     [](const Settings& s) { return is(s, "contact.adhesion", "capillary"); },
                 .idle = without_bridges},
                {.name = "contact.adhesion_shear",
                 .type = KeyType::real,
                 .need = Need::conditional,
                 .range = positive,
                 .help = "shear strength of a bond over its tensile strength",
                 .remedy = "Write for example adhesion_shear: 1.",
                 .when = "contact.adhesion: cohesion",
                 .required =
                     [](const Settings& s) { return is(s, "contact.adhesion", "cohesion"); },
                 .idle = without_bonds},
            },
        .rules = {
            {"contact.static_friction", {"contact.friction"}, sliding_holds_less},
            {"contact.impact", {"contact.restitution_tangential"}, moreau_has_one_restitution},
            {"grains.shape", {"contact.rolling_friction"}, only_discs_resist_rolling},
            {"contact.adhesion_range", {"contact.adhesion"}, range_of_neighbours}}};
}

}  // namespace turbidite
