// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Grains files with velocities, densities, materials and prescribed motions; materials and pairs;
// moving walls. All of it is in the resolved case, which reads back to the same.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/case/case_test.hpp"

namespace turbidite {
namespace {

constexpr const char* header = "id,x,y,vx,vy,spin,density,material,motion\n";

class RichCase : public CaseTest {
 protected:
    RichCase()
        : CaseTest(
              "domain: {size: [10, 20]}\n"
              "grains: {file: g.csv, adapter: standalone-nscd}\n"
              "fluid: {enabled: false}\n"
              "contact:\n"
              "  materials:\n"
              "    steel: {friction: 0.1}\n"
              "    rubber: {friction: 0.9, restitution: 0.4}\n"
              "  pairs:\n"
              "    steel-rubber: {friction: 0.5}\n"
              "time: {step: 0.01, end: 1}\n") {
        folder.write("g.csv", std::string(header) +
                                  "1,2,2,0.5,-0.25,3,0.8,steel,free\n"
                                  "2,5,5,1,0,0,2,default,driven\n"
                                  "3,8,8,0,0,0,1,rubber,fixed\n");
    }

    std::string refusal_of_row(const std::string& row,
                               const std::vector<std::string>& set = {}) const {
        folder.write("bad.csv", header + row);
        std::vector<std::string> all{"grains.file=bad.csv"};
        all.insert(all.end(), set.begin(), set.end());
        return refusal("", all);
    }
};

TEST_F(RichCase, ReachesTheParticipants) {
    const ResolvedCase resolved = load();
    EXPECT_EQ(resolved.settings.text("run.materials"), "rubber steel");
    const GrainState &steel = resolved.population.at(0), &driven = resolved.population.at(1),
                     &fixed = resolved.population.at(2);
    EXPECT_EQ(steel.material, 2);
    EXPECT_EQ(steel.velocity, (Vec3{0.5, -0.25, 0.0}));
    EXPECT_EQ(steel.angular_velocity[2], 3.0);
    EXPECT_EQ(steel.density, 0.8);
    EXPECT_FALSE(steel.prescribed);
    EXPECT_TRUE(driven.prescribed);
    EXPECT_EQ(driven.velocity[0], 1.0);
    EXPECT_TRUE(fixed.prescribed);
    EXPECT_EQ(fixed.material, 1);
}

TEST_F(RichCase, ResolvedCaseReadsBackToTheSame) {
    const ResolvedCase first =
        load("", {"domain.left_motion=shake", "domain.motions.shake.kind=harmonic",
                  "domain.motions.shake.amplitude=[0.1, 0]", "domain.motions.shake.period=2"});
    folder.write("run/case.yaml", first.yaml);
    folder.write("run/grains/initial.csv", first.grains_csv);
    const ResolvedCase second = load_run_folder(folder.path() / "run");
    EXPECT_EQ(second.grains_csv, first.grains_csv);
    EXPECT_EQ(second.settings.text("run.wall_motions"), first.settings.text("run.wall_motions"));
    EXPECT_EQ(second.settings.text("contact.pairs.steel-rubber.friction"), "0.5");
    EXPECT_EQ(second.yaml, first.yaml);
}

TEST_F(RichCase, RowsThatMakeNoSenseAreRefused) {
    EXPECT_SAYS(refusal_of_row("1,2,2,0,0,0,1,glass,free\n"), "material = glass");
    EXPECT_SAYS(refusal_of_row("1,2,2,0,0,0,1,glass,free\n"), "default, rubber, steel");
    EXPECT_SAYS(refusal_of_row("1,2,2,0,0,0,1,steel,loose\n"), "motion = loose");
    EXPECT_SAYS(refusal_of_row("1,2,2,1,0,0,1,steel,fixed\n"), "is fixed and has a velocity");
    EXPECT_SAYS(refusal_of_row("1,2,2,fast,0,0,1,steel,free\n"), "vx = fast");
    EXPECT_SAYS(refusal_of_row("1,2,2,0,0,0,0,steel,free\n"), "density = 0");
    EXPECT_SAYS(
        refusal_of_row("1,2,2,0,0,0,0.9,steel,free\n",
                       {"fluid.enabled=true", "fluid.reynolds=36", "coupling.scheme=split"}),
        "density = 0.9");
}

TEST_F(RichCase, MaterialsMustFitTogether) {
    EXPECT_SAYS(refusal("", {"contact.pairs.steel-glass.friction=0.1"}),
                "There is no material glass; there are default, rubber, steel.");
    EXPECT_SAYS(refusal("", {"contact.law=static-dynamic", "contact.static_friction=0.5"}),
                "contact.materials.rubber.");
    EXPECT_SAYS(refusal("", {"contact.materials.steel.restitution=2"}),
                "contact.materials.steel.restitution = 2");
    EXPECT_SAYS(refusal("", {"contact.materials.steel.colour=1"}),
                "contact.materials.steel.colour is unknown");
    EXPECT_SAYS(refusal("", {"contact.materials.steel.frictoin=0.1"}),
                "Did you mean contact.materials.steel.friction?");
    EXPECT_SAYS(refusal("", {"contact.pairs.steel-rubber.frictoin=0.1"}),
                "Did you mean contact.pairs.steel-rubber.friction?");
    EXPECT_SAYS(refusal("", {"contact.materials.steel=1"}), "is a group of keys");
    EXPECT_SAYS(refusal("", {"grains.adapter=yade-md"}), "yade-md has one material");
    EXPECT_SAYS(refusal("", {"grains.adapter=yade-md"}), "yade-md supports free grains only");
}

// A pair takes what it does not give from its materials, not from contact.*.
TEST_F(RichCase, StaticFrictionOfAPairIsThatOfItsMaterials) {
    std::vector<std::string> set{"contact.law=static-dynamic", "contact.static_friction=0.5",
                                 "contact.materials.rubber.static_friction=0.95",
                                 "contact.materials.steel.static_friction=0.8"};
    // Steel and rubber stick with 0.8: more than 0.5 is fine, more than 0.8 is not.
    set.push_back("contact.pairs.steel-rubber.friction=0.7");
    EXPECT_EQ(refusal("", set), "");
    set.back() = "contact.pairs.steel-rubber.friction=0.9";
    EXPECT_SAYS(refusal("", set), "static_friction = 0.8, friction = 0.9");
    // Steel slides with 0.1, so that its pairs may stick with less than contact.friction.
    set.back() = "contact.pairs.default-steel.static_friction=0.2";
    EXPECT_EQ(refusal("", set), "");
}

// Of a pair in both orders one would win as a whole.
TEST_F(RichCase, APairIsWrittenInOneOrder) {
    const std::string text = refusal("", {"contact.pairs.rubber-steel.restitution=0.3"});
    EXPECT_SAYS(text, "contact.pairs.steel-rubber.friction = 0.5");
    EXPECT_SAYS(text, "contact.pairs.rubber-steel and contact.pairs.steel-rubber are one pair");
    EXPECT_SAYS(text, "Write all of its coefficients below contact.pairs.rubber-steel.");
    EXPECT_EQ(refusal("", {"contact.pairs.steel-rubber.restitution=0.3",
                           "contact.pairs.steel-steel.friction=0.2"}),
              "");
}

class MovingWalls : public CaseTest {
 protected:
    MovingWalls()
        : CaseTest(
              "domain: {size: [10, 20]}\n"
              "grains: {count: 1, adapter: standalone-nscd}\n"
              "fluid: {enabled: false}\n"
              "scales: {kind: physical, diameter: 2, velocity: 4, gravity: 1, fluid_density: 1, "
              "viscosity: 1}\n"
              "time: {step: 0.01, end: 1}\n") {}

    std::vector<std::string> with(std::vector<std::string> set) const {
        set.push_back("domain.right_motion=m");
        return set;
    }
};

// D = 2, u_c = 4, t_c = 1/2.
TEST_F(MovingWalls, MotionsAreInRunUnits) {
    const auto motions = [&](const std::vector<std::string>& set) {
        return load("", with(set)).settings.text("run.wall_motions");
    };
    EXPECT_EQ(motions({"domain.motions.m.kind=constant", "domain.motions.m.velocity=[-1, 0.5]"}),
              "1 constant -4 2 0");
    EXPECT_EQ(motions({"domain.motions.m.kind=harmonic", "domain.motions.m.amplitude=[1, 0]",
                       "domain.motions.m.period=3", "domain.motions.m.phase=0.25"}),
              "1 harmonic 2 0 0 1.5 0.25");
    EXPECT_EQ(motions({"domain.motions.m.kind=table", "domain.motions.m.table=[0,0,0,2,-1,0.5]"}),
              "1 table 0 0 0 0 1 -2 1 0");
    EXPECT_EQ(load().settings.text("run.wall_motions"), "");
}

TEST_F(MovingWalls, InnerWallsNameThem) {
    folder.write("w.csv", "id,x1,y1,x2,y2,motion\n7,1,15,3,15,m\n8,5,15,7,15,\n");
    const std::vector<std::string> set{"domain.walls_file=w.csv", "domain.motions.m.kind=harmonic",
                                       "domain.motions.m.turn=0.3", "domain.motions.m.period=2"};
    EXPECT_EQ(load("", set).settings.text("run.wall_motions"), "4 harmonic 0 0 0.3 1 0");
    EXPECT_SAYS(refusal("", {"domain.walls_file=w.csv"}), "wall 7: motion = m");
}

TEST_F(MovingWalls, GrainsNameThem) {
    folder.write("g.csv", "id,x,y,motion\n5,2,3,m\n6,4,3,free\n");
    const std::vector<std::string> set{"grains.file=g.csv", "domain.motions.m.kind=harmonic",
                                       "domain.motions.m.turn=0.3", "domain.motions.m.period=2"};
    EXPECT_EQ(load("", set).settings.text("run.grain_motions"), "5 harmonic 0 0 0.3 1 0");
    std::vector<std::string> others = set;
    others.push_back("grains.adapter=external");
    others.push_back("grains.command=true");
    EXPECT_SAYS(refusal("", others), "no grain follows a motion of domain.motions");
}

TEST_F(MovingWalls, AMotionThatNothingFollowsIsNoted) {
    folder.write("g.csv", "id,x,y,motion\n5,2,3,m\n6,4,3,free\n");
    const auto told = [&](std::vector<std::string> set) {
        set.push_back("domain.motions.m.kind=constant");
        const auto notes = load("", set).notes;
        return std::ranges::count(notes, "no side, wall or grain follows domain.motions.m");
    };
    EXPECT_EQ(told({}), 1);
    EXPECT_EQ(told({"domain.right_motion=m"}), 0);
    EXPECT_EQ(told({"grains.file=g.csv"}), 0);
}

TEST_F(MovingWalls, WhatMakesNoSenseIsRefused) {
    const std::string kind = "domain.motions.m.kind=";
    EXPECT_SAYS(refusal("", with({})), "domain.right_motion = m");
    EXPECT_SAYS(refusal("", with({"domain.motions.m.velocity=[1,0]"})),
                "domain.motions.m.kind is missing");
    EXPECT_SAYS(refusal("", with({kind + "circular"})), "Available: constant, harmonic, table.");
    EXPECT_SAYS(refusal("", with({kind + "harmonic"})), "needs domain.motions.m.period");
    const std::string still = refusal("", with({kind + "harmonic", "domain.motions.m.period=0"}));
    EXPECT_SAYS(still, "domain.motions.m.period = 0");
    EXPECT_EQ(still.find("needs domain.motions.m.period"), std::string::npos) << still;
    EXPECT_SAYS(refusal("", with({kind + "constant", "domain.motions.m.period=2"})),
                "A constant motion has no period");
    EXPECT_SAYS(refusal("", with({kind + "table", "domain.motions.m.table=[0,0,0,0,1,1]"})),
                "times increase");
    EXPECT_SAYS(refusal("", with({kind + "constant", "domain.motions.m.spin=1"})), "does not turn");
    EXPECT_SAYS(refusal("", with({kind + "constant", "domain.right=free"})), "Only walls can move");
    EXPECT_SAYS(refusal("", with({kind + "constant", "domain.motions.m.velocity=[-1, 0]",
                                  "fluid.enabled=true"})),
                "the x component of its motion must be 0");
    EXPECT_SAYS(refusal("", with({kind + "constant", "grains.adapter=yade-md"})),
                "yade-md does not support moving sides");
}

class SidesOfTheFluid : public CaseTest {
 protected:
    SidesOfTheFluid()
        : CaseTest(
              "domain:\n"
              "  size: [10, 20]\n"
              "  motions:\n"
              "    slide: {kind: constant, velocity: [0, 2]}\n"
              "    rise: {kind: harmonic, amplitude: [0, 1], period: 2}\n"
              "    press: {kind: table, table: [0, 0, 0, 1, 0.1, 0]}\n"
              "grains: {count: 1, adapter: standalone-nscd}\n"
              "fluid: {reynolds: 36}\n"
              "time: {step: 0.01, end: 1}\n") {}
};

TEST_F(SidesOfTheFluid, WallsSlideAndInflowsLetFluidIn) {
    const ResolvedCase resolved =
        load("", {"domain.left_motion=slide", "domain.bottom=inflow", "domain.bottom_motion=rise",
                  "domain.top=free", "domain.bottom_profile=parabolic"});
    EXPECT_EQ(resolved.settings.text("run.wall_motions"), "0 constant 0 2 0");
    EXPECT_EQ(resolved.settings.text("run.inflow_motions"), "2 harmonic 0 1 0 2 0");
    EXPECT_EQ(resolved.settings.text("domain.bottom_profile"), "parabolic");
    for (const std::string& note : resolved.notes)
        EXPECT_EQ(note.find("no effect"), std::string::npos) << note;
}

TEST_F(SidesOfTheFluid, WhatMovesIntoTheFluidIsRefused) {
    for (const char* motion : {"slide", "rise"})
        EXPECT_SAYS(refusal("", {std::string("domain.top_motion=") + motion}),
                    "the y component of its motion must be 0");
    EXPECT_SAYS(refusal("", {"domain.left_motion=press"}), "domain.left_motion = press");
    EXPECT_NO_THROW(load("", {"domain.bottom_motion=press"}));
}

TEST_F(SidesOfTheFluid, AnInflowNeedsAVelocityAndAFluid) {
    EXPECT_SAYS(refusal("", {"domain.left=inflow", "domain.right=free"}), "domain.left = inflow");
    EXPECT_SAYS(refusal("", {"domain.left=inflow", "domain.right=free"}), "domain.left_motion");
    EXPECT_SAYS(
        refusal("", {"domain.left=inflow", "domain.left_motion=press", "fluid.enabled=false"}),
        "Without a fluid nothing enters");
    EXPECT_SAYS(refusal("", {"domain.left=inflow", "domain.left_motion=nobody"}),
                "no motion of this name");
}

TEST_F(SidesOfTheFluid, WhatEntersMustLeave) {
    const std::vector<std::string> closed{"domain.bottom=inflow", "domain.bottom_motion=rise"};
    EXPECT_SAYS(refusal("", closed), "The box has no free side");
    std::vector<std::string> through = closed;
    through.insert(through.end(), {"domain.top=inflow", "domain.top_motion=rise"});
    EXPECT_NO_THROW(load("", through));
    through.back() = "domain.top_motion=slide";
    EXPECT_SAYS(refusal("", through), "domain.bottom = inflow");
}

// Every thousandth of the run is a whole number of periods.
TEST_F(SidesOfTheFluid, WhatEntersMustLeaveInEveryWindow) {
    const std::vector<std::string> closed{"domain.bottom=inflow", "domain.bottom_motion=rise",
                                          "domain.motions.rise.period=0.05", "time.end=50"};
    EXPECT_SAYS(refusal("", closed), "by 0.01 t_c not as much fluid has left");
    // Two motions that agree at the end of every fifth window only.
    std::vector<std::string> through = closed;
    through.insert(
        through.end(),
        {"domain.top=inflow", "domain.top_motion=late", "domain.motions.late.kind=harmonic",
         "domain.motions.late.amplitude=[0,1]", "domain.motions.late.period=0.025"});
    EXPECT_SAYS(refusal("", through), "by 0.01 t_c not as much fluid has left");
    through.back() = "domain.motions.late.period=0.05";
    EXPECT_NO_THROW(load("", through));
}

TEST_F(SidesOfTheFluid, AProfileWithoutAnInflowIsNoted) {
    const auto notes = load("", {"domain.left_profile=parabolic"}).notes;
    ASSERT_FALSE(notes.empty());
    EXPECT_SAYS(notes.back(), "domain.left_profile has no effect with domain.left: wall");
}

}  // namespace
}  // namespace turbidite
