// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/participant/abilities.hpp"

#include <algorithm>
#include <initializer_list>

#include "coupler/participant/turbidite.h"

namespace turbidite {
namespace {

bool is_text(const Settings& s, const char* key, const char* plain) {
    return s.has(key) && s.text(key) != plain;
}

bool is_number(const Settings& s, const char* key) {
    return s.has(key) && s.real(key) != 0.0;
}

bool is_given(const Settings& s, const char* key) {
    return s.has(key) && !s.text(key).empty();
}

std::string named(const Settings& s, const char* key) {
    return std::string(key) + " = " + s.text(key);
}

std::string open_side(const Settings& s) {
    for (const char* side : {"domain.left", "domain.right", "domain.bottom", "domain.top",
                             "domain.front", "domain.back"})
        if (s.has(side) && (s.text(side) == "free" || s.text(side) == "cyclic"))
            return named(s, side);
    return {};
}

/// The first law of contacts beyond Coulomb friction.
std::string law(const Settings& s) {
    if (is_text(s, "contact.law", "coulomb")) return named(s, "contact.law");
    for (const char* kind : {"contact.adhesion", "contact.film"})
        if (is_text(s, kind, "none")) return named(s, kind);
    for (const char* number : {"contact.restitution", "contact.restitution_tangential",
                               "contact.rolling_friction", "contact.torsion_friction"})
        if (is_number(s, number)) return named(s, number);
    return {};
}

}  // namespace

std::string beyond(const Abilities& able, const Settings& s,
                   const std::vector<GrainState>& grains) {
    if (!able.ranks && s.has("grains.ranks") && s.integer("grains.ranks") > 1)
        return named(s, "grains.ranks") + ": it runs on one rank";
    if (const std::string side = open_side(s); !able.open_sides && !side.empty())
        return side + ": it knows walls on all sides only";
    if (!able.inner_walls && is_given(s, "run.walls"))
        return "domain.walls_file: it knows no walls inside the box";
    if (!able.moving_walls && is_given(s, "run.wall_motions"))
        return "domain.motions: it knows no walls that move";
    const auto held = std::find_if(grains.begin(), grains.end(),
                                   [](const GrainState& grain) { return grain.prescribed; });
    if (!able.given_motions && held != grains.end())
        return "grain " + std::to_string(held->id) +
               " has a given motion: it moves free grains "
               "only";
    if (!able.materials && (is_given(s, "run.materials") || is_number(s, "run.side_material")))
        return "contact.materials: it knows one material";
    if (!able.friction && is_number(s, "contact.friction"))
        return named(s, "contact.friction") + ": it knows no friction";
    if (const std::string other = law(s); !able.laws && !other.empty())
        return other + ": it does not know this law of contacts";
    return {};
}

Abilities abilities_of(std::uint64_t bits) {
    const auto has = [&](std::uint64_t ability) { return (bits & ability) == ability; };
    return {.ranks = has(TURBIDITE_KNOWS_RANKS),
            .open_sides = has(TURBIDITE_KNOWS_OPEN_SIDES),
            .inner_walls = has(TURBIDITE_KNOWS_INNER_WALLS),
            .moving_walls = has(TURBIDITE_KNOWS_MOVING_WALLS),
            .given_motions = has(TURBIDITE_KNOWS_GIVEN_MOTIONS),
            .materials = has(TURBIDITE_KNOWS_MATERIALS),
            .friction = has(TURBIDITE_KNOWS_FRICTION),
            .laws = has(TURBIDITE_KNOWS_LAWS)};
}

}  // namespace turbidite
