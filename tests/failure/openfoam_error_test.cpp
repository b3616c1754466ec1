// SPDX-License-Identifier: LGPL-2.1-or-later
//
// OpenFOAM refuses something in its own way: a FatalError, which ends the program after a page of
// text. The user gets that text.
#include "tests/failure/failing_run.hpp"
#include "tests/failure/stopwatch.hpp"

namespace turbidite {
namespace {

TEST_F(FailingRun, AFatalErrorOfOpenFoamIsToldInItsOwnWords) {
    const Answer first = shell(run_line("--set time.end=0.5"));
    ASSERT_EQ(first.code, 0) << first.err;
    // A user edits the OpenFOAM case of a run and goes on with it.
    const auto schemes = run_folder() / "fluid/system/fvSchemes";
    ASSERT_TRUE(std::filesystem::exists(schemes));
    std::ofstream(schemes, std::ios::app) << "\n#include \"no-such-file\"\n";
    const Stopwatch watch;
    const Answer answer = shell("timeout 60 " TURBIDITE_PROGRAM " resume run --set time.end=1");
    EXPECT_LT(watch.seconds(), longest);
    EXPECT_EQ(answer.code, 4) << answer.out << answer.err;
    EXPECT_SAYS(answer.err, "The run failed: fluid rank 0 (");
    EXPECT_SAYS(answer.err, "no-such-file");
    EXPECT_SAYS(answer.err, "logs/fluid.log");
    EXPECT_EQ(record().at("exit_code"), 4);
    expect_nothing_left();
}

}  // namespace
}  // namespace turbidite
