// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a program says that it can do, and the cases that ask for more.
#include "coupler/participant/abilities.hpp"

#include <gtest/gtest.h>

#include "coupler/participant/turbidite.h"
#include "coupler/protocol/files/whole_file.hpp"

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
                                     {"contact.torsion_friction", "0"},
                                     {"coupling.scheme", "split"},
                                     {"coupling.positions", "corrected"}})
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
    {"run.walls", "7 1 1 3 1 0 0 0 2 1 0 0.1", "domain.walls_file", &Abilities::inner_walls},
    {"run.wall_motions", "left ...", "domain.motions", &Abilities::moving_walls},
    {"run.materials", "steel", "contact.materials", &Abilities::materials},
    {"run.side_material", "1", "contact.materials", &Abilities::materials},
    {"contact.friction", "0.3", "contact.friction = 0.3", &Abilities::friction},
    {"contact.law", "sticky", "contact.law = sticky", &Abilities::laws},
    {"contact.adhesion", "cohesion", "contact.adhesion = cohesion", &Abilities::laws},
    {"contact.film", "lubrication", "contact.film = lubrication", &Abilities::laws},
    {"contact.pairs.default-default.friction", "0", "contact.pairs.default-default.friction = 0",
     &Abilities::materials},
    {"contact.materials.steel.friction", "0.5", "contact.materials.steel", &Abilities::friction},
    {"contact.restitution", "0.5", "contact.restitution = 0.5", &Abilities::restitution},
    {"contact.materials.steel.restitution", "0.5", "contact.materials.steel.restitution = 0.5",
     &Abilities::restitution},
    {"contact.pairs.default-steel.rolling_friction", "0.1", "contact.pairs.default-steel.rolling",
     &Abilities::laws},
    {"coupling.positions", "contact", "coupling.positions = contact",
     &Abilities::contact_positions},
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
        Abilities others{true, true, true, true, true, true, true, true, true, true};
        others.*asked.needed = false;
        EXPECT_NE(beyond(others, s, {}), "") << asked.key;
    }
}

TEST(Abilities, AnotherImpactLawIsOneWhereThereIsRestitution) {
    const Abilities able{.friction = true, .restitution = true};
    Settings s = plain();
    s.set("contact.impact", std::string("moreau"));
    EXPECT_EQ(beyond(able, s, {}), "");
    s.set("contact.restitution", std::string("0.5"));
    EXPECT_EQ(beyond(able, s, {}).rfind("contact.impact = moreau", 0), 0u);
    s.set("contact.impact", std::string("newton"));
    EXPECT_EQ(beyond(able, s, {}), "");
}

TEST(Abilities, AFilmWithoutALiquidAsksForNothing) {
    Settings s = plain();
    s.set("contact.film", std::string("lubrication"));
    for (const auto& [fluid, told] : {std::pair{"true", "contact.film"}, {"false", ""}}) {
        s.set("fluid.enabled", std::string(fluid));
        EXPECT_EQ(beyond({}, s, {}).substr(0, 12), told);
    }
}

// A wall inside the box has its constant motion and its friction in its own line.
TEST(Abilities, WallsInsideMoveAndRubByTheirOwnLine) {
    const auto with = [](const char* dimension, const char* wall, const Abilities& able) {
        Settings s = plain();
        s.set("run.dimension", std::string(dimension));
        s.set("run.walls", std::string(wall));
        return beyond(able, s, {});
    };
    const Abilities walls{.inner_walls = true}, rubbing{.inner_walls = true, .friction = true},
        moving{.inner_walls = true, .moving_walls = true};
    const char* still = "7 1 1 3 1 0 0 0 2 1 0 0.1";
    const char* turning = "7 1 1 3 1 0 0 0.5 2 1 0 0.1";
    const char* rough = "7 1 1 3 1 0 0 0 2 1 0.3 0.1";
    EXPECT_EQ(with("2", still, walls), "");
    EXPECT_NE(with("2", turning, walls).find("wall 7 moves"), std::string::npos);
    EXPECT_EQ(with("2", turning, moving), "");
    EXPECT_NE(with("2", rough, walls).find("wall 7 has friction"), std::string::npos);
    EXPECT_EQ(with("2", rough, rubbing), "");
    const char* drum = "9 cylinder 1 1 0 0 0 4 0 0 0 3 0 0.2 0 0 0 0 0 0.1 1 1 0 0 -1";
    EXPECT_NE(with("3", drum, walls).find("wall 9 moves"), std::string::npos);
    EXPECT_EQ(with("3", drum, moving), "");
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
               a.materials + a.friction + a.restitution + a.laws + a.contact_positions;
    };
    EXPECT_EQ(count(TURBIDITE_KNOWS_NO_MORE), 0);
    for (const std::uint64_t one :
         {TURBIDITE_KNOWS_RANKS, TURBIDITE_KNOWS_OPEN_SIDES, TURBIDITE_KNOWS_INNER_WALLS,
          TURBIDITE_KNOWS_MOVING_WALLS, TURBIDITE_KNOWS_GIVEN_MOTIONS, TURBIDITE_KNOWS_MATERIALS,
          TURBIDITE_KNOWS_FRICTION, TURBIDITE_KNOWS_RESTITUTION, TURBIDITE_KNOWS_LAWS,
          TURBIDITE_KNOWS_CONTACT_POSITIONS})
        EXPECT_EQ(count(one), 1) << one;
    const Abilities two = abilities_of(TURBIDITE_KNOWS_FRICTION | TURBIDITE_KNOWS_MATERIALS);
    EXPECT_TRUE(two.friction && two.materials && !two.laws && !two.ranks);
}

TEST(Abilities, PythonHasTheSameBits) {
    const std::string module = read_whole(std::filesystem::path(TURBIDITE_SOURCE_DIR) /
                                          "coupler/participant/python/turbidite_adapter.py");
    for (const auto& [name, bits] : {std::pair{"ranks", TURBIDITE_KNOWS_RANKS},
                                     {"open_sides", TURBIDITE_KNOWS_OPEN_SIDES},
                                     {"inner_walls", TURBIDITE_KNOWS_INNER_WALLS},
                                     {"moving_walls", TURBIDITE_KNOWS_MOVING_WALLS},
                                     {"given_motions", TURBIDITE_KNOWS_GIVEN_MOTIONS},
                                     {"materials", TURBIDITE_KNOWS_MATERIALS},
                                     {"friction", TURBIDITE_KNOWS_FRICTION},
                                     {"restitution", TURBIDITE_KNOWS_RESTITUTION},
                                     {"laws", TURBIDITE_KNOWS_LAWS},
                                     {"contact_positions", TURBIDITE_KNOWS_CONTACT_POSITIONS}})
        EXPECT_NE(module.find("'" + std::string(name) + "': " + std::to_string(bits)),
                  std::string::npos)
            << name;
}

}  // namespace
}  // namespace turbidite
