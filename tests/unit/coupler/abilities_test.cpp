// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a program says that it can do, and the cases that ask for more.
#include "coupler/participant/abilities.hpp"

#include <gtest/gtest.h>

#include "coupler/participant/turbidite.h"

namespace turbidite {
namespace {

/// As the launcher resolves the plainest case in space.
Settings plain() {
    Settings s;
    for (const char* side : {"left", "right", "bottom", "top", "front", "back"})
        s.set(std::string("domain.") + side, std::string("wall"));
    for (const auto& [key, value] : {std::pair{"grains.ranks", "1"},
                                     {"run.walls", ""},
                                     {"run.wall_motions", ""},
                                     {"run.materials", ""},
                                     {"contact.friction", "0"},
                                     {"contact.law", "coulomb"},
                                     {"contact.adhesion", "none"},
                                     {"contact.film", "none"},
                                     {"contact.restitution", "0"},
                                     {"contact.restitution_tangential", "0"},
                                     {"contact.rolling_friction", "0"},
                                     {"contact.torsion_friction", "0"}})
        s.set(key, std::string(value));
    return s;
}

struct Asked {
    const char* key;
    const char* value;
    const char* told;
    bool Abilities::*needed;
};

const Asked all_asked[] = {
    {"grains.ranks", "2", "grains.ranks = 2", &Abilities::ranks},
    {"domain.right", "free", "domain.right = free", &Abilities::open_sides},
    {"domain.back", "cyclic", "domain.back = cyclic", &Abilities::open_sides},
    {"run.walls", "1 2 3", "domain.walls_file", &Abilities::inner_walls},
    {"run.wall_motions", "left ...", "domain.motions", &Abilities::moving_walls},
    {"run.materials", "steel", "contact.materials", &Abilities::materials},
    {"run.side_material", "1", "contact.materials", &Abilities::materials},
    {"contact.friction", "0.3", "contact.friction = 0.3", &Abilities::friction},
    {"contact.law", "sticky", "contact.law = sticky", &Abilities::laws},
    {"contact.adhesion", "cohesion", "contact.adhesion = cohesion", &Abilities::laws},
    {"contact.film", "lubrication", "contact.film = lubrication", &Abilities::laws},
    {"contact.restitution", "0.5", "contact.restitution = 0.5", &Abilities::laws},
    {"contact.restitution_tangential", "0.5", "contact.restitution_tangential", &Abilities::laws},
    {"contact.rolling_friction", "0.1", "contact.rolling_friction", &Abilities::laws},
    {"contact.torsion_friction", "0.1", "contact.torsion_friction", &Abilities::laws},
};

TEST(Abilities, TheLeastPlaysThePlainestCase) {
    EXPECT_EQ(beyond({}, plain(), {GrainState{}}), "");
    EXPECT_EQ(beyond({}, Settings{}, {}), "") << "keys that are not there ask for nothing";
    Settings inflow = plain();  // a wall for grains
    inflow.set("domain.left", std::string("inflow"));
    EXPECT_EQ(beyond({}, inflow, {}), "");
}

TEST(Abilities, WhatGoesBeyondIsRefusedByItsKeyUnlessTheProgramKnowsIt) {
    for (const Asked& asked : all_asked) {
        Settings s = plain();
        s.set(asked.key, std::string(asked.value));
        EXPECT_EQ(beyond({}, s, {}).rfind(asked.told, 0), 0u) << beyond({}, s, {});
        Abilities able;
        able.*asked.needed = true;
        EXPECT_EQ(beyond(able, s, {}), "") << asked.key;
        Abilities others{true, true, true, true, true, true, true, true};
        others.*asked.needed = false;
        EXPECT_NE(beyond(others, s, {}), "") << asked.key;
    }
}

TEST(Abilities, GivenMotionsAreThoseOfTheGrains) {
    GrainState held;
    held.id = 42;
    held.prescribed = true;
    EXPECT_EQ(beyond({}, plain(), {GrainState{}, held}).rfind("grain 42 has a given motion", 0),
              0u);
    EXPECT_EQ(beyond({.given_motions = true}, plain(), {held}), "");
}

TEST(Abilities, OfTheBitsOfTheCInterface) {
    const auto count = [](std::uint64_t bits) {
        const Abilities a = abilities_of(bits);
        return a.ranks + a.open_sides + a.inner_walls + a.moving_walls + a.given_motions +
               a.materials + a.friction + a.laws;
    };
    EXPECT_EQ(count(TURBIDITE_KNOWS_NO_MORE), 0);
    for (const std::uint64_t one :
         {TURBIDITE_KNOWS_RANKS, TURBIDITE_KNOWS_OPEN_SIDES, TURBIDITE_KNOWS_INNER_WALLS,
          TURBIDITE_KNOWS_MOVING_WALLS, TURBIDITE_KNOWS_GIVEN_MOTIONS, TURBIDITE_KNOWS_MATERIALS,
          TURBIDITE_KNOWS_FRICTION, TURBIDITE_KNOWS_LAWS})
        EXPECT_EQ(count(one), 1) << one;
    const Abilities two = abilities_of(TURBIDITE_KNOWS_FRICTION | TURBIDITE_KNOWS_MATERIALS);
    EXPECT_TRUE(two.friction && two.materials && !two.laws && !two.ranks);
}

}  // namespace
}  // namespace turbidite
