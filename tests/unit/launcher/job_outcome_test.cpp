// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/job_outcome.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include "coupler/protocol/files/kept_lines.hpp"
#include "coupler/protocol/files/run_files.hpp"
#include "launcher/job/folder/run_json.hpp"
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

// logs/first_end, and the wait-for table that the coupler left behind.
TEST_F(Outcome, NamesTheProgramThatEndedFirstWithPhaseAndLog) {
    scratch.write("logs/coupler.log", "window 5\n");
    KeptLines table(wait_table_file(scratch.path()));
    table.set(0, "  fluid rank 0 (host vm, pid 12) is due to send \"kicks\", window 5, for 0 s");
    table.set(1,
              "  grains rank 0 (host vm, pid 13) waits for the coupler's \"kick\", window 5, for 0 "
              "s");
    scratch.write("history.csv", "step\n0\n");
    scratch.write("logs/fluid.log", "cannot open shared library\n");
    ASSERT_TRUE(write_first_end(scratch.path(),
                                {ExitCode::participant_failed, "fluid rank 0", "ended quietly"}));
    EXPECT_FALSE(write_first_end(scratch.path(), {ExitCode::stalled, "grains rank 0", "late"}));
    const JobOutcome outcome = settle_outcome(folder, {.status = 4}, ranks);
    EXPECT_EQ(outcome.code, ExitCode::participant_failed);
    EXPECT_EQ(outcome.error, "fluid rank 0 ended quietly, log " + folder.log("fluid").string() +
                                 "; it was due to send \"kicks\", window 5");
    const std::string text = outcome_text(folder, outcome);
    EXPECT_SAYS(text, "Last lines of logs/fluid.log:\n    cannot open shared library\n");
    EXPECT_EQ(text.find("coupler.log"), std::string::npos) << text;
}

// A program that gives up since the coupler is silent leaves its own code.
TEST_F(Outcome, TheFirstEndDecidesTheCode) {
    std::filesystem::create_directories(folder.logs());
    write_first_end(scratch.path(),
                    {ExitCode::stalled, "grains rank 1", "gave up: the coupler is silent"});
    const JobOutcome outcome = settle_outcome(folder, {.status = 4}, ranks);
    EXPECT_EQ(outcome.code, ExitCode::stalled);
    EXPECT_SAYS(outcome.error, "grains rank 1 gave up: the coupler is silent");
    EXPECT_SAYS(outcome.error, "the run had not begun");
    // A replay, which has no history, is in the middle of one.
    std::filesystem::remove(folder.record());
    const JobOutcome again = settle_outcome(folder, {.status = 4}, {"replay", "grains rank 1"});
    EXPECT_SAYS(again.error, "grains rank 1 gave up");
    EXPECT_EQ(again.error.find("had not begun"), std::string::npos) << again.error;
}

// As scancel sends it.
TEST_F(Outcome, ASignalToAllProgramsIsAnInterruption) {
    std::filesystem::create_directories(folder.logs());
    write_first_end(scratch.path(), {ExitCode::participant_failed, "coupler",
                                     "was ended by signal 15 (Terminated)"});
    EXPECT_EQ(settle_outcome(folder, {.status = 143, .signal = SIGTERM}, ranks).code,
              ExitCode::terminated);
    scratch.write("run.json", "{}");
    EXPECT_EQ(settle_outcome(folder, {.status = 143}, ranks).code, ExitCode::participant_failed);
}

// Every program repeats the reason in its log; it is shown once.
TEST_F(Outcome, TheReasonIsNotRepeatedByTheLog) {
    scratch.write("run.json",
                  R"({"exit_code": 3, "error": "incompatible:\n  grains rank 0: no discs"})");
    scratch.write("logs/coupler.log",
                  "grains rank 0  mine\nturbidite: incompatible:\n  grains rank 0: no discs\n");
    const std::string text = outcome_text(folder, settle_outcome(folder, {.status = 3}, ranks));
    EXPECT_SAYS(text, "The run failed: incompatible:\n  grains rank 0: no discs\n");
    EXPECT_EQ(text.find("no discs"), text.rfind("no discs")) << text;
    EXPECT_SAYS(text, "grains rank 0  mine");
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
    // The cause is next to the advice, not above the logs.
    EXPECT_SAYS(text, "The run failed: grains failed\nResults so far in ");
    EXPECT_GT(text.find("The run failed"), text.find("a process died"));
}

TEST_F(Outcome, SuccessSaysWhereThingsAre) {
    EXPECT_SAYS(outcome_text(folder, {}), ": history.csv;");
    scratch.write("report.html", "<html>");
    EXPECT_SAYS(outcome_text(folder, {}), ": report.html, history.csv;");
}

}  // namespace
}  // namespace turbidite
