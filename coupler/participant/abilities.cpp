// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/participant/abilities.hpp"

#include <algorithm>
#include <initializer_list>

#include "coupler/participant/turbidite.h"
#include "coupler/protocol/scene/plates.hpp"
#include "coupler/protocol/scene/space_walls.hpp"

namespace turbidite {
namespace {

bool is_text(const Settings& s, const char* key, const char* plain) {
    return s.has(key) && s.text(key) != plain;
}

bool is_given(const Settings& s, const char* key) {
    return s.has(key) && !s.text(key).empty();
}

std::string named(const Settings& s, const std::string& key) {
    return key + " = " + s.text(key);
}

std::string open_side(const Settings& s) {
    for (const char* side : {"domain.left", "domain.right", "domain.bottom", "domain.top",
                             "domain.front", "domain.back"})
        if (s.has(side) && (s.text(side) == "free" || s.text(side) == "cyclic"))
            return named(s, side);
    return {};
}

/// A coefficient of contact.*, contact.materials.NAME.* or contact.pairs.A-B.* that is not zero.
std::string coefficient(const Settings& s, const std::string& name) {
    const auto is_meant = [&](const std::string& key) {
        const bool ends = key.size() > name.size() && key[key.size() - name.size() - 1] == '.' &&
                          key.compare(key.size() - name.size(), name.size(), name) == 0;
        return ends && (key == "contact." + name || key.rfind("contact.materials.", 0) == 0 ||
                        key.rfind("contact.pairs.", 0) == 0);
    };
    for (const auto& [key, value] : s.entries())
        if (is_meant(key) && s.real(key) != 0.0) return named(s, key);
    return {};
}

/// The first law of contacts beyond Coulomb friction and restitution.
std::string law(const Settings& s) {
    if (is_text(s, "contact.law", "coulomb")) return named(s, "contact.law");
    if (is_text(s, "contact.adhesion", "none")) return named(s, "contact.adhesion");
    // Without a liquid there are no films.
    const bool dry = s.has("fluid.enabled") && !s.flag("fluid.enabled");
    if (!dry && is_text(s, "contact.film", "none")) return named(s, "contact.film");
    if (is_text(s, "contact.impact", "newton") && !coefficient(s, "restitution").empty())
        return named(s, "contact.impact");
    for (const char* number : {"restitution_tangential", "rolling_friction", "torsion_friction"})
        if (std::string found = coefficient(s, number); !found.empty()) return found;
    return {};
}

/// A wall inside the box.
struct InnerWall {
    GrainId id = 0;
    double friction = 0.0;
    bool moves = false;
};

template <class Walls>
std::vector<InnerWall> inner_walls(const Walls& walls) {
    std::vector<InnerWall> result;
    for (const auto& wall : walls) {
        const Twist rate = wall.motion->rate(0.0, 1.0);
        result.push_back({wall.id, wall.friction, rate.velocity != Vec3{} || rate.spin != Vec3{}});
    }
    return result;
}

std::vector<InnerWall> inner_walls(const Settings& s) {
    if (!is_given(s, "run.walls")) return {};
    const bool in_space = s.has("run.dimension") && s.integer("run.dimension") == 3;
    return in_space ? inner_walls(space_walls_of(s)) : inner_walls(plates_of(s));
}

std::string beyond_walls(const Abilities& able, const Settings& s) {
    if (!able.inner_walls && is_given(s, "run.walls"))
        return "domain.walls_file: it knows no walls inside the box";
    if (!able.moving_walls && is_given(s, "run.wall_motions"))
        return "domain.motions: it knows no walls that move";
    if (able.moving_walls && able.friction) return {};
    for (const InnerWall& wall : inner_walls(s)) {
        const std::string of = "domain.walls_file: wall " + std::to_string(wall.id);
        if (!able.moving_walls && wall.moves) return of + " moves: it knows no walls that move";
        if (!able.friction && wall.friction != 0.0)
            return of + " has friction: it knows no friction";
    }
    return {};
}

std::string beyond_contacts(const Abilities& able, const Settings& s) {
    const bool materials = is_given(s, "run.materials") ||
                           (s.has("run.side_material") && s.integer("run.side_material") != 0);
    if (!able.materials && materials) return "contact.materials: it knows one material";
    // It replaces contact.friction and the like, which a program of one material reads.
    for (const auto& [key, value] : s.entries())
        if (!able.materials && key.rfind("contact.pairs.default-default.", 0) == 0)
            return named(s, key) + ": it knows no pairs of materials";
    if (const std::string one = coefficient(s, "friction"); !able.friction && !one.empty())
        return one + ": it knows no friction";
    if (const std::string one = coefficient(s, "restitution"); !able.restitution && !one.empty())
        return one + ": it knows no restitution";
    if (const std::string one = law(s); !able.laws && !one.empty())
        return one + ": it does not know this law of contacts";
    return {};
}

}  // namespace

std::string beyond(const Abilities& able, const Settings& s,
                   const std::vector<GrainState>& grains) {
    if (!able.ranks && s.has("grains.ranks") && s.integer("grains.ranks") > 1)
        return named(s, "grains.ranks") + ": it runs on one rank";
    if (const std::string side = open_side(s); !able.open_sides && !side.empty())
        return side + ": it knows walls on all sides only";
    const auto held = std::find_if(grains.begin(), grains.end(),
                                   [](const GrainState& grain) { return grain.prescribed; });
    if (!able.given_motions && held != grains.end())
        return "grain " + std::to_string(held->id) +
               " has a given motion: it moves free grains only";
    if (!able.contact_positions && is_text(s, "coupling.positions", "corrected"))
        return named(s, "coupling.positions") + ": it moves with the corrected velocities";
    if (const std::string reason = beyond_walls(able, s); !reason.empty()) return reason;
    return beyond_contacts(able, s);
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
            .restitution = has(TURBIDITE_KNOWS_RESTITUTION),
            .laws = has(TURBIDITE_KNOWS_LAWS),
            .contact_positions = has(TURBIDITE_KNOWS_CONTACT_POSITIONS)};
}

}  // namespace turbidite
