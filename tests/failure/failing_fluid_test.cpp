// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A fluid that sends invalid answers, throws or exits: runs of an installation whose
// turbidite-fluid is faulty_fluid.
#include "tests/failure/failing_fluid.hpp"

namespace turbidite {
namespace {

TEST_F(FailingFluid, MultipliersThatStopAtTheirLimitInThreeConsecutiveWindows) {
    const Answer answer = run_with("unsolved");
    EXPECT_EQ(answer.code, 6);
    EXPECT_SAYS(answer.err, "stopped at its iteration limit in 3 consecutive windows");
    EXPECT_SAYS(answer.err, "fluid.multiplier_iterations = ");
    EXPECT_SAYS(answer.err, "fluid.multiplier_tolerance = ");
    expect_good_output_is_kept(ExitCode::physics_refused);
    EXPECT_EQ(rows_of_history(), 8);  // t = 0 and windows 0 to 6
    expect_nothing_left();
}

TEST_F(FailingFluid, NanInAKick) {
    const Answer answer = run_with("nan");
    EXPECT_EQ(answer.code, 6);
    EXPECT_SAYS(answer.err, "kick for grain ");
    EXPECT_SAYS(answer.err, "velocity is not finite: (nan, ");
    EXPECT_SAYS(answer.err, "in \"kicks\" of window 5");
    expect_good_output_is_kept(ExitCode::physics_refused);
    EXPECT_EQ(rows_of_history(), 6);  // t = 0 and windows 0 to 4
    expect_nothing_left();
}

TEST_F(FailingFluid, ProjectionThatFails) {
    const Answer answer = run_with("divergence");
    EXPECT_EQ(answer.code, 6);
    EXPECT_SAYS(answer.err,
                "the projection failed in 3 consecutive windows: max |div phi| = 1 u_c/D");
    expect_good_output_is_kept(ExitCode::physics_refused);
    EXPECT_EQ(rows_of_history(), 8);  // windows 5 and 6 are tolerated, 7 is not
    expect_nothing_left();
}

TEST_F(FailingFluid, ErrorReachesTheUserWithRoleAndLog) {
    const Answer answer = run_with("throw");
    EXPECT_EQ(answer.code, 4);
    EXPECT_SAYS(answer.err, "The run failed: fluid rank 0 (scripted-fluid, host ");
    EXPECT_SAYS(answer.err, "logs/fluid.log): scripted trouble");
    expect_good_output_is_kept(ExitCode::participant_failed);
    expect_nothing_left();
}

}  // namespace
}  // namespace turbidite
