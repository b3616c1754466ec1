// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/progress.hpp"

#include <gtest/gtest.h>

#include <iterator>

#include "tests/unit/coupler/test_case.hpp"

namespace turbidite {
namespace {

/// A window in a run of 70 t_c that will take hours.
struct LateWindow {
    LateWindow() {
        run.windows = 7000;
        run.step = 0.01;
        run.output_every = 50;
        state.report.max_penetration = 3e-5;
        state.grains = test_population();
        for (GrainState& grain : state.grains) grain.velocity = {0.0, 0.3456, 0.0};
        row.step = 6000;
        row.time = 60.0;
        row.state = &state;
        row.contact = &contact;
        row.fluid = &fluid;
    }

    RunValues run = run_values(test_settings());
    Motion state;
    ContactReport contact;
    FluidReport fluid;
    Row row;
};

TEST(Progress, FitsSixtyColumns) {
    LateWindow window;
    EXPECT_EQ(progress_line(window.row, window.run, 8.0),
              "60.0/70 t_c  fall -0.346 u_c  overlap 3e-05 D  2:13:20 left");
    EXPECT_LE(progress_line(window.row, window.run, 8.0).size(), 60u);
}

// 0.05 of 0.05 t_c was told as 0.1 of 0.05.
TEST(Progress, TellsTimesOfShortIntervals) {
    LateWindow window;
    window.run.output_every = 5;
    EXPECT_TRUE(progress_line(window.row, window.run, 8.0).starts_with("60.00/70 t_c"));
    window.run.output_every = 50;
    window.run.windows = 7001;
    EXPECT_TRUE(progress_line(window.row, window.run, 8.0).starts_with("60.00/70.01 t_c"));
    window.run.output_every = 7000;  // beyond the end
    window.run.windows = 100;
    window.row.time = 0.97;
    EXPECT_TRUE(progress_line(window.row, window.run, 8.0).starts_with("1.0/1 t_c"));
}

TEST(Progress, SaysThatASolveStoppedAtItsLimit) {
    LateWindow window;
    window.fluid.multipliers_converged = false;
    EXPECT_NE(progress_line(window.row, window.run, 0.5).find("NOT CONVERGED"), std::string::npos);
}

TEST(Progress, TheLogHasTheSolvesAsWell) {
    const TestFolder folder("progress");
    LateWindow window;
    window.fluid.courant = 0.25;
    window.fluid.multiplier_iterations = 17;
    Progress progress(folder.path() / "coupler.log", false, window.run);
    progress.show(window.row, true);
    std::ifstream file(folder.path() / "coupler.log");
    const std::string log{std::istreambuf_iterator<char>(file), {}};
    for (const char* part : {"window 6000/7000", "multipliers 17 its", "Courant 0.25"})
        EXPECT_NE(log.find(part), std::string::npos) << part << " in " << log;
}

}  // namespace
}  // namespace turbidite
