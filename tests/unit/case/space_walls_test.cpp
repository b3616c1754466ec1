// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Walls inside the box in space, their materials, and grains that fill a cylinder.
#include "launcher/case/walls/space_walls.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/protocol/scene/plates.hpp"
#include "coupler/rigid/vec3.hpp"
#include "tests/unit/case/case_test.hpp"

namespace turbidite {
namespace {

class SpaceWallsCase : public CaseTest {
 protected:
    SpaceWallsCase()
        : CaseTest(R"(
dimension: 3
domain: {size: [20, 30, 20], walls_file: w.csv}
grains: {adapter: standalone-nscd, file: g.csv}
fluid: {enabled: false}
scales: {kind: physical, diameter: 0.5, gravity: 10, fluid_density: 1, viscosity: 1, velocity: 2}
time: {step: 0.01, end: 1}
contact: {friction: 0.3}
)") {
        folder.write("g.csv", "id,x,y,z\n1,10,5,10\n");
    }
    void walls(const std::string& rows, const std::string& header = all) const {
        folder.write("w.csv", header + "\n" + rows);
    }
    std::string refusal_of(const std::string& row,
                           const std::vector<std::string>& overrides = {}) const {
        walls(row);
        return refusal("", overrides);
    }

    static constexpr const char* all =
        "id,kind,x,y,z,ax,ay,az,bx,by,bz,r1,r2,thickness,wx,wy,wz,friction,material,motion";
};

const std::string steel = "contact.materials.steel.friction=0.1";

TEST_F(SpaceWallsCase, WallsAreSentInTheUnitsOfTheRun) {
    walls(
        "0,plate,1,2,3,4,0,0,0,0,6,,,0.2,,,,0.7,,\n"
        "1,cylinder,10,4,10,0,8,0,,,,6,,,0,3,0,,steel,\n"
        "2,cone,10,4,10,0,-3,0,,,,6,2,,,,,,,still\n"
        "3,ring,10,1,10,0,1,0,,,,1,2,,,,,,,\n");
    const ResolvedCase resolved =
        load("", {steel, "domain.motions.still.kind=constant", "domain.material=steel"});
    const Settings& s = resolved.settings;
    EXPECT_EQ(s.integer("run.side_material"), 1);
    const std::vector<SpaceWall> sent = space_walls_of(s);
    ASSERT_EQ(sent.size(), 4u);
    EXPECT_EQ(sent[0].key, first_plate(3));
    EXPECT_EQ(sent[0].kind, SpaceWallKind::plate);
    EXPECT_EQ(sent[0].place, (Vec3{0.5, 1.0, 1.5}));
    EXPECT_EQ(sent[0].b, (Vec3{0, 0, 3}));
    EXPECT_EQ(sent[0].pivot, (Vec3{1.5, 1.0, 3.0}));
    EXPECT_EQ(sent[0].thickness, 0.1);
    EXPECT_EQ(sent[0].friction, 0.7);
    EXPECT_EQ(sent[0].material, -1);
    EXPECT_EQ(sent[1].material, 1);
    EXPECT_EQ(sent[1].radius, 3.0);
    EXPECT_EQ(sent[1].motion->rate(0, 1).spin, (Vec3{0, 12, 0}));  // t_c = 0.25 s
    EXPECT_EQ(sent[2].radius2, 1.0);
    EXPECT_EQ(sent[2].friction, 0.3);
    EXPECT_TRUE(sent[2].motion->rate(0, 1).at_rest());
    EXPECT_EQ(sent[3].kind, SpaceWallKind::ring);
    EXPECT_NE(s.text("run.wall_motions").find("8 constant"), std::string::npos);
}

TEST_F(SpaceWallsCase, TheCopyInTheRunFolderIsReadAlike) {
    walls(
        "0,plate,1,2,3,4,0,0,0,0,6,,,0.2,,,,0.7,,\n"
        "1,cylinder,10,4,10,0,8,0,,,,6,,,0,3,0,,,\n"
        "2,ring,10,1,10,0,1,0,,,,0,2,,,,,,,\n");
    const ResolvedCase first = load();
    folder.write("w.csv", first.walls_csv);
    const ResolvedCase second = load();
    EXPECT_EQ(first.walls_csv, second.walls_csv);
    EXPECT_EQ(first.settings.text("run.walls"), second.settings.text("run.walls"));
}

TEST_F(SpaceWallsCase, EachFaultHasItsSentence) {
    EXPECT_SAYS(refusal_of("0,sphere,1,1,1,0,1,0,,,,1,,,,,,,,\n"),
                "A wall is one of plate, cylinder, cone, ring.");
    EXPECT_SAYS(refusal_of("0,cylinder,1,1,1,0,1,0,,,,,,,,,,,,\n"), "r1 is missing");
    EXPECT_SAYS(refusal_of("0,cylinder,1,1,1,0,1,0,,,,1,2,,,,,,,\n"), "r2 is given");
    EXPECT_SAYS(refusal_of("0,cylinder,1,1,1,0,0,0,,,,1,,,,,,,,\n"), "ax, ay, az have length 0");
    EXPECT_SAYS(refusal_of("0,ring,1,1,1,0,1,0,,,,2,1,,,,,,,\n"), "outside its hole");
    EXPECT_SAYS(refusal_of("0,plate,1,1,1,2,0,0,1,1,0,,,,,,,,,\n"), "right angle");
    EXPECT_SAYS(refusal_of("0,plate,1,1,1,2,0,0,0,1,,,,,,,,,,\n"),
                "of bx, by, bz not all are given");
    EXPECT_SAYS(refusal_of("0,cylinder,1,1,1,0,1,0,,,,1,,,,,,,glass,\n"), "There are default.");
    EXPECT_SAYS(refusal_of("0,cylinder,1,1,1,0,1,0,,,,1,,,,,,-1,,\n"), "friction = -1");
    EXPECT_SAYS(refusal_of("0,cylinder,1,1,1,0,1,0,,,,1,,-1,,,,,,\n"), "thickness = -1");
    EXPECT_SAYS(refusal_of("0,cylinder,1,1,1,0,1,0,,,,1,,,,1,,,,\n"),
                "of wx, wy, wz not all are given");
    EXPECT_SAYS(refusal_of("0,cylinder,1,1,1,0,1,0,,,,1,,,,,,,,gone\n"), "motion = gone");
    walls("0,cylinder,1,1,1,0,1,0,,,,1,,,,,,0.1,steel,\n");
    EXPECT_SAYS(refusal("", {steel}), "it has a material and a friction");
    walls("0,cylinder,1,1,1,0,1,0,,,,1,,,1,0,0,,,turn\n");
    EXPECT_SAYS(refusal("", {"domain.motions.turn.kind=constant"}),
                "no velocity and spin of its own");
    walls("0,cylinder,1,1,1,0,1,0,,,,1,,,,,,,,\n");
    EXPECT_SAYS(refusal("", {"domain.material=wood"}), "There is no material wood");
    EXPECT_SAYS(refusal("", {"grains.adapter=lammps-md"}),
                "Walls inside the box need a contact-dynamics adapter, not lammps-md.");
}

/// The sphere at (10, 5, 10) of radius 0.5.
TEST_F(SpaceWallsCase, GrainsThatAWallCutsAreRefused) {
    EXPECT_EQ(refusal_of("0,cylinder,10,0,10,0,10,0,,,,0.51,,,,,,,,\n"), "");
    EXPECT_SAYS(refusal_of("0,cylinder,10.1,0,10,0,10,0,,,,0.51,,,,,,,,\n"),
                "wall 0 cuts grain 1 at (10, 5, 10) by 0.09 D");
    EXPECT_SAYS(refusal_of("0,ring,10,5.2,10,0,1,0,,,,0.4,3,,,,,,,\n"), "wall 0 cuts grain 1");
    EXPECT_EQ(refusal_of("0,ring,10,5.2,10,0,1,0,,,,0.5,3,,,,,,,\n"), "");
    EXPECT_SAYS(refusal_of("0,plate,9,5.2,9,2,0,0,0,0,2,,,,,,,,,\n"), "wall 0 cuts grain 1");
    EXPECT_EQ(refusal_of("0,plate,11,5.2,9,2,0,0,0,0,2,,,,,,,,,\n"), "");
}

// The image of the plate at x = 21 to 23 is at 1 to 3; that of the ring 19 to 21 is at -1 to 1.
TEST_F(SpaceWallsCase, GrainsThatAnImageCutsAreRefused) {
    folder.write("g.csv", "id,x,y,z\n1,0.75,5,10\n");
    const std::vector<std::string> cyclic = {"domain.left=cyclic", "domain.right=cyclic"};
    for (const char* row :
         {"0,plate,20.5,5.2,9,2,0,0,0,0,2,,,,,,,,,\n", "0,plate,-59.5,5.2,9,2,0,0,0,0,2,,,,,,,,,\n",
          "0,ring,19.8,5.2,10,0,1,0,,,,0,1,,,,,,,\n"}) {
        walls(row);
        EXPECT_EQ(refusal(""), "") << row;
        EXPECT_SAYS(refusal("", cyclic), "wall 0 cuts grain 1 at (0.75, 5, 10) by 0.3 D");
    }
    EXPECT_EQ(refusal_of("0,plate,19,5.2,9,0.5,0,0,0,0,2,,,,,,,,,\n", cyclic), "");
}

/// It would lie on its own images.
TEST_F(SpaceWallsCase, AWallThatIsLongerThanTheBoxRepeatsIsRefused) {
    EXPECT_EQ(refusal_of("0,cylinder,10,0,0,0,0,21,,,,8,,,,,,,,\n"), "");
    const std::vector<std::string> cyclic = {"domain.front=cyclic", "domain.back=cyclic"};
    EXPECT_SAYS(refusal("", cyclic), "wall 0 is 21 D long along z");
    EXPECT_EQ(refusal_of("0,cylinder,10,0,0,0,0,20,,,,8,,,,,,,,\n", cyclic), "");
    EXPECT_SAYS(refusal_of("0,cylinder,10,0,10,0,9,0,,,,10.1,,,,,,,,\n", cyclic),
                "wall 0 is 20.2 D long along z");
    EXPECT_SAYS(refusal_of("0,plate,1,2,1,4,0,0,0,0,22,,,,,,,,,\n", cyclic),
                "wall 0 is 22 D long along z");
    // About x, y and its own axis.
    EXPECT_SAYS(refusal_of("0,plate,2,3,10,0,24,0,2,0,0,,,,1,0,0,,,\n", cyclic),
                "wall 0 is 24 D long along z when it has turned");
    EXPECT_EQ(refusal_of("0,plate,2,3,10,0,24,0,2,0,0,,,,0,1,0,,,\n", cyclic), "");
    EXPECT_EQ(refusal_of("0,cylinder,10,0,0,0,0,20,,,,8,,,0,0,1,,,\n", cyclic), "");
}

/// Two shells of neighbours would be one in the other; the ends of a thick wall meet those of its
/// image.
TEST_F(SpaceWallsCase, ThicknessCountsAcrossAWallAndNotAlongIt) {
    const std::vector<std::string> cyclic = {"domain.front=cyclic", "domain.back=cyclic"};
    EXPECT_EQ(refusal_of("0,cylinder,10,0,10,0,9,0,,,,9.9,,0.2,,,,,,\n", cyclic), "");
    EXPECT_SAYS(refusal_of("0,cylinder,10,0,10,0,9,0,,,,9.9,,0.4,,,,,,\n", cyclic),
                "wall 0 is 20.2 D long along z");
    EXPECT_EQ(refusal_of("0,cylinder,10,0,0,0,0,20,,,,8,,0.4,,,,,,\n", cyclic), "");
    EXPECT_EQ(refusal_of("0,plate,1,2,0,4,0,0,0,0,20,,,0.4,,,,,,\n", cyclic), "");
    EXPECT_SAYS(refusal_of("0,plate,1,2,5,4,0,0,0,2,0,,,20.5,,,,,,\n", cyclic),
                "wall 0 is 20.5 D long along z");
}

class CylinderCase : public CaseTest {
 protected:
    CylinderCase()
        : CaseTest(R"(
dimension: 3
domain: {size: [20, 30, 20]}
grains: {adapter: standalone-nscd, cylinder: [10, 2, 10, 10, 22, 10, 6], count: 500}
fluid: {enabled: false}
time: {step: 0.01, end: 1}
)") {}

    /// How many grains there are; all of them inside the cylinder around y.
    static std::size_t count_inside(const ResolvedCase& resolved) {
        double lowest = 30.0, highest = 0.0, farthest = 0.0;
        for (const GrainState& grain : resolved.population) {
            const Vec3& x = grain.position;
            lowest = std::min(lowest, x[1] - grain.radius);
            highest = std::max(highest, x[1] + grain.radius);
            farthest = std::max(farthest, std::hypot(x[0] - 10, x[2] - 10) + grain.radius);
        }
        EXPECT_GE(lowest, 2.0 - 1e-9);
        EXPECT_LE(highest, 22.0 + 1e-9);
        EXPECT_LE(farthest, 6.0 + 1e-9);
        EXPECT_LT(lowest, 3.0);
        EXPECT_GT(highest, 21.0);
        EXPECT_GT(farthest, 5.5);
        return resolved.population.size();
    }
};

TEST_F(CylinderCase, GeneratorsFillIt) {
    EXPECT_EQ(count_inside(load()), 500u);
    EXPECT_EQ(count_inside(load("", {"grains.count=1500"})), 1500u);  // shaken from a lattice
    const std::size_t lattice = count_inside(
        load("", {"grains.generator=lattice", "grains.compacity=0.5", "grains.jitter=0.05"}));
    EXPECT_GT(lattice, 1600u);  // 0.5 of 2262 D3 are 2160 spheres, fewer at the border
    EXPECT_LT(lattice, 2160u);
}

TEST_F(CylinderCase, WhatIsNoRegionIsRefused) {
    EXPECT_SAYS(refusal("", {"grains.cylinder=[10, 2, 10, 10, 22, 10, 11]"}), "lies in the box");
    EXPECT_SAYS(refusal("", {"grains.cylinder=[10, 2, 10, 10, 2, 10, 3]"}), "lies in the box");
    EXPECT_SAYS(refusal("", {"grains.cylinder=[10, 2, 10]"}), "Seven numbers");
    EXPECT_SAYS(refusal("", {"grains.region=[10, 10, 10]"}), "Remove one of them.");
    EXPECT_SAYS(refusal("", {"grains.generator=poured"}), "poured into boxes");
    EXPECT_SAYS(refusal("", {"grains.count=5000"}), "a cylinder of 2262 D3");
}

}  // namespace
}  // namespace turbidite
