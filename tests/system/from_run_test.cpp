// SPDX-License-Identifier: LGPL-2.1-or-later
//
// `turbidite run CASE --from DIR[@time]`: a run that starts from the grains of another one.
#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

const char* const the_case = R"(
domain: {size: [11, 8]}
grains: {adapter: standalone-nscd, generator: lattice, region: [5, 7], jitter: 0.0005}
fluid: {enabled: false}
contact: {friction: 0.3}
time: {step: 0.0125, end: 3}
output: {interval: 1}
)";

const char* const state[] = {"mean_velocity_x", "mean_velocity_y", "mean_speed",
                             "mean_position_x", "mean_position_y", "kinetic_energy"};

class FromRun : public ShellTest {
 protected:
    void SetUp() override { scratch.write("case.yaml", the_case); }

    Answer run(const std::string& options) const {
        return shell(std::string(TURBIDITE_PROGRAM) + " run case.yaml " + options);
    }

    Columns history(const std::string& folder) const {
        return columns_of(text(scratch.path() / folder / "history.csv"));
    }
};

TEST_F(FromRun, BeginsWithTheGrainsOfThatTime) {
    ASSERT_EQ(run("--out whole").code, 0);
    const Answer answer = run("--from whole@2 --out rest --set time.end=1");
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_SAYS(answer.out + answer.err, "at 2 t_c");
    const Columns whole = history("whole"), rest = history("rest");
    EXPECT_EQ(rest.at("time").front(), 0.0);
    EXPECT_GT(whole.at("mean_speed")[2], 0.1);  // in motion
    for (const char* column : state) {
        EXPECT_NEAR(rest.at(column).front(), whole.at(column)[2], 1e-8) << column;
        // Only the initial guess of the contact impulses is lost.
        EXPECT_NEAR(rest.at(column).back(), whole.at(column)[3], 0.02) << column;
    }
}

TEST_F(FromRun, WithoutATimeBeginsWithTheEnd) {
    ASSERT_EQ(run("--out whole").code, 0);
    ASSERT_EQ(run("--from whole --out rest --set time.end=1").code, 0);
    EXPECT_NEAR(history("rest").at("mean_position_y").front(),
                history("whole").at("mean_position_y").back(), 1e-8);
}

TEST_F(FromRun, WhatIsNotThereIsRefusedByName) {
    ASSERT_EQ(run("--out whole --set time.end=1").code, 0);
    const Answer late = run("--from whole@7 --out rest");
    EXPECT_EQ(late.code, 2);
    EXPECT_SAYS(late.err, "no output at 7 t_c");
    EXPECT_SAYS(late.err, "the nearest is @1");
    const Answer nowhere = run("--from nowhere --out rest");
    EXPECT_EQ(nowhere.code, 2);
    EXPECT_SAYS(nowhere.err, "nowhere");
}

}  // namespace
}  // namespace turbidite
