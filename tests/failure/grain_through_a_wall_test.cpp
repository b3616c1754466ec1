// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One sweep of the contact solver, and steps in which a grain falls several diameters: contacts are
// not solved, and grains move into each other and out of the box.
#include "tests/failure/failing_run.hpp"

namespace turbidite {
namespace {

const std::string careless =
    "--set fluid.enabled=false --set grains.count=16 --set contact.iterations=1 "
    "--set time.step=1 --set output.interval=1 ";

TEST_F(FailingRun, OverlapEndsTheRun) {
    const Answer answer = shell(run_line(careless));
    EXPECT_EQ(answer.code, 6);
    EXPECT_SAYS(answer.err, "limits.penetration = 0.2 D");
    EXPECT_SAYS(answer.err, "Use a smaller time.step, or more contact.iterations");
    EXPECT_SAYS(answer.err, "`turbidite resume` ends in the same way");
    expect_nothing_left();
}

TEST_F(FailingRun, GrainThroughAWallEndsTheRun) {
    with_reports();
    const Answer answer = shell(run_line(careless + "--set limits.penetration=100"));
    EXPECT_EQ(answer.code, 6);
    EXPECT_SAYS(answer.err, "has its centre beyond the ");
    EXPECT_SAYS(answer.err, "use a smaller time.step");
    expect_good_output_is_kept(ExitCode::physics_refused);
    expect_report();
    expect_nothing_left();
}

}  // namespace
}  // namespace turbidite
