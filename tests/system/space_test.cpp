// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A case in space from its file to the files of its run: a column of spheres collapses on a floor,
// in a box that is cyclic along its depth.
#include <cmath>

#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

const char* const column = R"(
dimension: 3
domain: {size: [16, 9, 5], front: cyclic, back: cyclic}
grains: {adapter: standalone-nscd, generator: lattice, region: [6, 8, 5], compacity: 0.6, jitter: 0.02}
fluid: {enabled: false}
contact: {friction: 0.4}
time: {step: 0.02, end: 6}
output: {interval: 0.5}
checkpoint: {interval: 3}
)";

class Space : public ShellTest {
 protected:
    void SetUp() override { scratch.write("case.yaml", column); }

    Answer turbidite(const std::string& words) const {
        return shell(std::string(TURBIDITE_PROGRAM) + " " + words);
    }
    Columns history(const std::string& folder) const {
        return columns_of(text(scratch.path() / folder / "history.csv"));
    }
    nlohmann::json record(const std::string& folder) const {
        return nlohmann::json::parse(text(scratch.path() / folder / "run.json"));
    }
};

TEST_F(Space, AColumnOfSpheresCollapses) {
    const Answer answer = turbidite("run case.yaml --out run");
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_SAYS(answer.out, "in [16, 9, 5] D");
    const Columns run = history("run");
    EXPECT_GE(run.at("grains").front(), 200.0);
    EXPECT_EQ(run.at("grains").front(), run.at("grains").back());  // none has left
    // It has spread along x, and stays in the middle of its depth.
    EXPECT_GT(run.at("front_x").back(), run.at("front_x").front() + 2.0);
    EXPECT_LT(run.at("mean_position_y").back(), 0.8 * run.at("mean_position_y").front());
    EXPECT_NEAR(run.at("mean_position_z").back(), 2.5, 0.3);
    // Its contacts know three dimensions.
    EXPECT_GT(run.at("coordination").back(), 2.0);
    EXPECT_GT(run.at("sigma_zz").back(), 0.05);
    EXPECT_GT(run.at("pore_volume").back(), 50.0);
    const auto maxima = record("run")["maxima"];
    EXPECT_LE(maxima["grain_balance"].get<double>(), 1e-11);
    EXPECT_LE(maxima["motion_defect"].get<double>(), 1e-9);
    EXPECT_LE(maxima["penetration"].get<double>(), 5e-3);
    const std::string grains = text(scratch.path() / "run/grains/grains_00000300.vtp");
    EXPECT_SAYS(grains, "orientation");
    EXPECT_SAYS(text(scratch.path() / "run/grains/contacts_00000300.vtp"), "torsion_moment");
}

TEST_F(Space, AResumedRunHasEqualBits) {
    ASSERT_EQ(turbidite("run case.yaml --out whole").code, 0);
    ASSERT_EQ(turbidite("run case.yaml --out parts --set time.end=3").code, 0);
    const Answer more = turbidite("resume parts --set time.end=6");
    ASSERT_EQ(more.code, 0) << more.err;
    EXPECT_EQ(lines_without_wall_times(text(scratch.path() / "whole/history.csv")),
              lines_without_wall_times(text(scratch.path() / "parts/history.csv")));
    for (const char* file : {"grains/grains_00000300.vtp", "grains/contacts_00000300.vtp"})
        EXPECT_EQ(text(scratch.path() / "whole" / file), text(scratch.path() / "parts" / file))
            << file;
}

TEST_F(Space, StartsFromAnotherRun) {
    ASSERT_EQ(turbidite("run case.yaml --out whole").code, 0);
    const Answer answer = turbidite("run case.yaml --from whole@4 --out rest --set time.end=1");
    ASSERT_EQ(answer.code, 0) << answer.err;
    const Columns whole = history("whole"), rest = history("rest");
    for (const char* name : {"mean_position_x", "mean_position_y", "mean_position_z",
                             "mean_velocity_x", "mean_velocity_z", "kinetic_energy"})
        EXPECT_NEAR(rest.at(name).front(), whole.at(name)[8], 1e-8) << name;
    EXPECT_GT(whole.at("kinetic_energy")[8], 1e-6);
}

/// A cup that stands on a disc, and a paddle that turns above it.
const char* const walls = R"(id,kind,x,y,z,ax,ay,az,bx,by,bz,r1,r2,material,motion
1,cone,5,1,5,0,2,0,,,,2,4,steel,
2,cylinder,5,3,5,0,8,0,,,,4,,steel,
3,ring,5,1,5,0,1,0,,,,0,2,steel,
4,plate,5,6,4,3,0,0,0,0,2,,,,stirring
)";

const char* const cup = R"(
dimension: 3
domain:
  size: [10, 16, 10]
  walls_file: walls.csv
  motions:
    stirring: {kind: constant, spin: 0.3, axis: [0, 1, 0]}
grains: {adapter: standalone-nscd, generator: random, cylinder: [5, 7, 5, 5, 16, 5, 4], count: 150}
fluid: {enabled: false}
contact: {friction: 0.4, materials: {steel: {friction: 0.1}}}
time: {step: 0.02, end: 8}
output: {interval: 2}
checkpoint: {interval: 4}
)";

TEST_F(Space, WallsInsideTheBoxHoldSpheres) {
    scratch.write("walls.csv", walls);
    scratch.write("cup.yaml", cup);
    const Answer answer = turbidite("run cup.yaml --out whole");
    ASSERT_EQ(answer.code, 0) << answer.err;
    const Columns whole = history("whole");
    EXPECT_EQ(whole.at("grains").back(), 150.0);
    EXPECT_GT(whole.at("mean_position_y").back(), 2.0);  // not below the disc
    EXPECT_LT(whole.at("mean_position_y").back(), 6.0);
    EXPECT_LE(record("whole")["maxima"]["penetration"].get<double>(), 1e-2);
    EXPECT_LE(record("whole")["maxima"]["grain_balance"].get<double>(), 1e-11);
    EXPECT_SAYS(text(scratch.path() / "whole/grains/contacts_00000400.vtp"), "normal_force");
    // What turns goes on where it was.
    ASSERT_EQ(turbidite("run cup.yaml --out parts --set time.end=4").code, 0);
    ASSERT_EQ(turbidite("resume parts --set time.end=8").code, 0);
    EXPECT_EQ(lines_without_wall_times(text(scratch.path() / "whole/history.csv")),
              lines_without_wall_times(text(scratch.path() / "parts/history.csv")));
    // YADE's scene does not have these walls, but its grains feel them.
    const Answer yade = turbidite("run cup.yaml --out yade --set grains.adapter=yade-nscd");
    ASSERT_EQ(yade.code, 0) << yade.err;
    EXPECT_SAYS(text(scratch.path() / "yade/logs/grains.log"), "4 walls inside the box are not in");
    EXPECT_EQ(history("yade").at("mean_position_y"), whole.at("mean_position_y"));
}

// The second run finds the packing of the first.
TEST_F(Space, PouredGrainsAreAtRestWhenTheRunBegins) {
    ::setenv("XDG_CACHE_HOME", scratch.path().c_str(), 1);
    const std::string poured =
        "run case.yaml --set grains.generator=poured --set grains.count=150 "
        "--set grains.jitter=0 --set time.end=0.5";
    const Answer first = turbidite(poured + " --out first");
    ASSERT_EQ(first.code, 0) << first.err;
    EXPECT_SAYS(first.out, "Pouring 150 grains");
    const Columns run = history("first");
    EXPECT_EQ(run.at("grains").front(), 150.0);
    EXPECT_LT(run.at("kinetic_energy").front(), 1e-4);
    EXPECT_LT(run.at("front_x").front(), 6.001);
    EXPECT_GT(run.at("mean_speed").back(), 0.01);  // its wall is gone
    const Answer second = turbidite(poured + " --out second");
    ::unsetenv("XDG_CACHE_HOME");
    EXPECT_SAYS(second.out, "150 grains were poured before");
    // Its line is to be played by a shell, and plays the same packing.
    ::setenv("TURBIDITE_CACHE", (scratch.path() / "turbidite").c_str(), 1);
    const Answer line = turbidite(poured + " --dry-run --out third");
    ::unsetenv("TURBIDITE_CACHE");
    EXPECT_EQ(line.out.find("poured"), std::string::npos) << line.out;
    EXPECT_SAYS(line.err, "150 grains were poured before");
    EXPECT_EQ(text(scratch.path() / "third/grains/initial.csv"),
              text(scratch.path() / "first/grains/initial.csv"));
    EXPECT_EQ(lines_without_wall_times(text(scratch.path() / "second/history.csv")),
              lines_without_wall_times(text(scratch.path() / "first/history.csv")));
}

// A limit that has ended the pouring is not the packing's: with another one it goes on.
TEST_F(Space, APouringThatEndedOnALimitGoesOnWithAnother) {
    ::setenv("XDG_CACHE_HOME", scratch.path().c_str(), 1);
    const std::string poured =
        "run case.yaml --set grains.generator=poured --set grains.count=150 "
        "--set grains.jitter=0 --set time.end=0.1";
    const Answer ended = turbidite(poured + " --set limits.penetration=1e-9 --out ended");
    EXPECT_EQ(ended.code, 6) << ended.err;
    EXPECT_SAYS(ended.err, "the same command goes on with it, with other limits.*");
    const Answer on = turbidite(poured + " --out on");
    ::unsetenv("XDG_CACHE_HOME");
    EXPECT_EQ(on.code, 0) << on.out << on.err;
    EXPECT_EQ(history("on").at("grains").front(), 150.0);
}

// A study pours them too, and knows the run again by its plan.
TEST_F(Space, PouredGrainsOfAStudyAreAtRestWhenItsRunsBegin) {
    ::setenv("XDG_CACHE_HOME", scratch.path().c_str(), 1);
    scratch.write("pours.yaml",
                  "out: s\nparts:\n  a:\n    case: case.yaml\n"
                  "    set: {grains.generator: poured, grains.jitter: 0, grains.count: 150, "
                  "time.end: 0.5}\n"
                  "    sweep: {grains.pour_friction: [0, 0.8]}\n");
    const Answer first = turbidite("study pours.yaml");
    ASSERT_EQ(first.code, 0) << first.err;
    const Answer second = turbidite("study pours.yaml");
    ::unsetenv("XDG_CACHE_HOME");
    EXPECT_SAYS(second.out, "2 runs, 2 of them done");
    EXPECT_EQ(second.out.find("Pouring"), std::string::npos) << second.out;
    const Columns dense = history("s/a/pour_friction-0"), loose = history("s/a/pour_friction-0.8");
    for (const Columns* run : {&dense, &loose}) {
        EXPECT_EQ(run->at("grains").front(), 150.0);
        EXPECT_LT(run->at("kinetic_energy").front(), 1e-4);
        EXPECT_GT(run->at("coordination").back(), 1.0);
    }
    // Where grains slip they come to rest nearer to the floor; stand-ins are on one lattice.
    EXPECT_LT(dense.at("mean_position_y").front(), loose.at("mean_position_y").front() - 0.05);
}

TEST_F(Space, CheckForecastsAndRefusesInWords) {
    const Answer good = turbidite("check case.yaml");
    EXPECT_EQ(good.code, 0) << good.err;
    EXPECT_SAYS(good.out + good.err, "forecast:");
    const Answer bad = turbidite(
        "check case.yaml --set \"domain.size=[16, 9]\" --set grains.shape=disc "
        "--set grains.adapter=yade-md --set fluid.enabled=true --set fluid.reynolds=10 "
        "--set fluid.points=interior+boundary");
    EXPECT_EQ(bad.code, 2);
    for (const char* part :
         {"In space length, height and depth", "In space grains are spheres",
          "yade-md does not support cyclic sides", "In space there are no points on surfaces"})
        EXPECT_SAYS(bad.err + bad.out, part);
}

// A program that was not made for space is told so before anything starts.
TEST_F(Space, APlanarProgramIsRefused) {
    const Answer answer =
        turbidite("run case.yaml --out run --set grains.adapter=external --set \"grains.command=" +
                  std::string(BROKEN_PROGRAMS) + "contact-grains\"");
    EXPECT_EQ(answer.code, 3) << answer.out << answer.err;
    EXPECT_SAYS(answer.out + answer.err, "dimension is 2, the case needs 3");
}

}  // namespace
}  // namespace turbidite
