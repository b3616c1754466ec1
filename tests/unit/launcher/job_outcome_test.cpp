// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/job_outcome.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include "launcher/job/run_json.hpp"
#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {
namespace {

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

class Outcome : public ::testing::Test {
 protected:
    ScratchFolder scratch;
    RunFolder folder{scratch.path()};
    const std::vector<std::string> ranks{"coupler", "fluid rank 0", "grains rank 0"};
};

TEST_F(Outcome, TheCouplersMessageCounts) {
    scratch.write("run.json", R"({"exit_code": 6, "error": "grain 3 is through the left wall"})");
    const JobOutcome outcome = settle_outcome(folder, {.status = 134}, ranks);
    EXPECT_EQ(outcome.code, ExitCode::physics_refused);
    EXPECT_EQ(outcome.error, "grain 3 is through the left wall");
}

TEST_F(Outcome, WithoutAMessageAProgramFailed) {
    scratch.write("run.json", R"({"exit_code": null, "case": "box"})");
    const JobOutcome outcome = settle_outcome(folder, {.status = 139}, ranks);
    EXPECT_EQ(outcome.code, ExitCode::participant_failed);
    EXPECT_SAYS(outcome.error, "mpirun ended with status 139");
    const auto record = read_run_json(folder.record());
    EXPECT_EQ(record.at("exit_code"), 4);
    EXPECT_EQ(record.at("status"), "failed");
    EXPECT_EQ(record.at("case"), "box");  // earlier entries remain
}

// The texts are those of Open MPI 4.1.4.
TEST_F(Outcome, NamesTheProgramThatASignalEnded) {
    scratch.write("logs/mpirun.log",
                  "Primary job  terminated normally, but 1 process returned\n"
                  "mpirun noticed that process rank 1 with PID 0 on node vm exited on signal 9 "
                  "(Killed).\n");
    const JobOutcome outcome = settle_outcome(folder, {.status = 137}, ranks);
    EXPECT_EQ(outcome.code, ExitCode::participant_failed);
    EXPECT_SAYS(outcome.error, "fluid rank 0 was ended by signal 9 (Killed)");
}

TEST_F(Outcome, NamesTheProgramThatLeftWithAStatus) {
    scratch.write("logs/mpirun.log",
                  "the job to be terminated. The first process to do so was:\n\n"
                  "  Process name: [[21423,1],2]\n  Exit code:    1\n");
    EXPECT_SAYS(settle_outcome(folder, {.status = 1}, ranks).error,
                "grains rank 0 ended with status 1");
}

TEST_F(Outcome, EndingWithoutAMessageIsNoSuccess) {
    EXPECT_EQ(settle_outcome(folder, {.status = 0}, ranks).code, ExitCode::participant_failed);
}

TEST_F(Outcome, DocumentedCodesOfMpirunPass) {
    EXPECT_EQ(settle_outcome(folder, {.status = 3}, ranks).code, ExitCode::handshake_refused);
}

TEST_F(Outcome, KilledOnRequest) {
    const JobEnd end{.status = 137, .signal = SIGINT, .killed = true};
    EXPECT_EQ(settle_outcome(folder, end, ranks).code, ExitCode::interrupted);
    EXPECT_EQ(read_run_json(folder.record()).at("status"), "interrupted");
}

TEST_F(Outcome, FailureShowsTheLogs) {
    scratch.write("logs/grains.log", "one\ntwo\nValueError: no such grain\n");
    scratch.write("logs/mpirun.log", "a process died\n");
    const std::string text =
        outcome_text(folder, {.code = ExitCode::participant_failed, .error = "grains failed"});
    EXPECT_SAYS(text, "The run failed: grains failed");
    EXPECT_SAYS(text, "Last lines of logs/grains.log");
    EXPECT_SAYS(text, "ValueError: no such grain");
    EXPECT_SAYS(text, "a process died");
    EXPECT_SAYS(text, "Exit code 4.");
}

TEST_F(Outcome, SuccessSaysWhereThingsAre) {
    EXPECT_SAYS(outcome_text(folder, {}), "report.html");
}

}  // namespace
}  // namespace turbidite
