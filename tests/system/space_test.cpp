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
    EXPECT_EQ(lines_without_wall_times(text(scratch.path() / "second/history.csv")),
              lines_without_wall_times(text(scratch.path() / "first/history.csv")));
}

TEST_F(Space, CheckForecastsAndRefusesInWords) {
    const Answer good = turbidite("check case.yaml");
    EXPECT_EQ(good.code, 0) << good.err;
    EXPECT_SAYS(good.out + good.err, "forecast:");
    const Answer bad = turbidite(
        "check case.yaml --set \"domain.size=[16, 9]\" --set grains.shape=disc "
        "--set grains.adapter=yade-md --set fluid.enabled=true --set fluid.reynolds=10");
    EXPECT_EQ(bad.code, 2);
    for (const char* part :
         {"In space length, height and depth", "In space grains are spheres",
          "yade-md does not support cyclic sides", "In space there is no fluid in this version"})
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
