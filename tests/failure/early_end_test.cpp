// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A program that ends before the run is over, quietly or not, before MPI_Init or in the middle:
// within seconds the job is gone, and one message tells who, how, when, and where its log is.
#include "tests/failure/failing_fluid.hpp"
#include "tests/failure/stopwatch.hpp"

namespace turbidite {
namespace {

int count(const std::string& text, const std::string& part) {
    int found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

struct End {
    const char* fault;
    const char* how;
    const char* due = "kicks";
};
class EarlyEnd : public FailingFluid, public ::testing::WithParamInterface<End> {
 protected:
    void expect_one_message(const Answer& answer) const {
        EXPECT_EQ(answer.code, 4) << answer.out << answer.err;
        EXPECT_EQ(count(answer.err, "The run failed: fluid rank 0 "), 1) << answer.err;
        EXPECT_EQ(count(answer.out + answer.err, GetParam().how), 1) << answer.out << answer.err;
        EXPECT_SAYS(answer.err, "program " + (scratch.path() / "bin/turbidite-fluid").string());
        EXPECT_EQ(count(answer.err, "Traceback"), 0) << answer.err;
        EXPECT_EQ(record().at("exit_code"), 4);
        expect_nothing_left();
    }
};

class EndBeforeMpi : public EarlyEnd {};

// Open MPI takes a program that exits with 0 for a good one if no other has reached MPI_Init yet:
// several tries.
TEST_P(EndBeforeMpi, EndsTheJob) {
    for (int attempt = 0; attempt < 4; ++attempt) {
        const Stopwatch watch;
        const Answer answer = run_with(GetParam().fault, "--force");
        EXPECT_LT(watch.seconds(), longest);
        expect_one_message(answer);
        EXPECT_SAYS(answer.err, "; the run had not begun");
        EXPECT_SAYS(answer.err, "Last lines of logs/fluid.log:\n    cannot find my libraries\n");
    }
}

INSTANTIATE_TEST_SUITE_P(Ends, EndBeforeMpi,
                         ::testing::Values(End{"early-0", "ended with status 0"},
                                           End{"early-3", "ended with status 3"}),
                         [](const auto& info) {
                             return std::string("Status") + std::string(info.param.fault).back();
                         });

// One message with who, how, program, host, process, log, phase and window, and the last words. The
// five windows before the end take a fraction of a second.
TEST_P(EarlyEnd, IsToldWithPhaseAndWindow) {
    const Stopwatch watch;
    const Answer answer = run_with(GetParam().fault);
    EXPECT_LT(watch.seconds(), longest);
    expect_one_message(answer);
    const auto start = answer.err.find("The run failed: ");
    const std::string message = answer.err.substr(start, answer.err.find('\n', start) - start);
    char host[256] = {};
    gethostname(host, sizeof host - 1);
    EXPECT_SAYS(message, "The run failed: fluid rank 0 " + std::string(GetParam().how));
    EXPECT_SAYS(message, std::string(", host ") + host + ", pid ");
    EXPECT_SAYS(message, "log " + (run_folder() / "logs/fluid.log").string());
    EXPECT_SAYS(message, std::string("; it was due to send \"") + GetParam().due + "\", window 5");
    EXPECT_SAYS(answer.err, "Last lines of logs/fluid.log:\n");
    // After a signal the last lines are Open MPI's list of calls, and its own words are above them.
    const bool by_signal = std::string(GetParam().how).find("signal") != std::string::npos;
    EXPECT_SAYS(by_signal ? text(run_folder() / "logs/fluid.log") : answer.err,
                "now comes " + std::string(GetParam().fault) + "\n");
    expect_good_output_is_kept(ExitCode::participant_failed);
}

INSTANTIATE_TEST_SUITE_P(
    Ends, EarlyEnd,
    ::testing::Values(End{"_exit-0", "ended with status 0"}, End{"_exit-3", "ended with status 3"},
                      End{"exit-0", "ended with status 0"},
                      End{"segfault", "was ended by signal 11"},
                      End{"terminate", "was ended by signal 6"},
                      End{"mpi-abort", "ended with status 77"},
                      End{"own-loop-throws", "ended with status 3", "response"},
                      End{"own-loop-returns", "ended with status 0", "response"}),
    [](const auto& info) {
        std::string name = info.param.fault;
        for (char& c : name)
            if (c == '-') c = '_';
        return name[0] == '_' ? "Quick" + name : name;
    });

// MPI_Finalize would wait for programs that wait for this one, and its words would be lost.
TEST_F(FailingFluid, WhatAHostThrowsIsTold) {
    for (const auto& [fault, words] : {std::pair{"own-loop-throws", "in my own words: "},
                                       std::pair{"joined-throws", "turbidite: fluid: "}}) {
        const Stopwatch watch;
        const Answer answer = run_with(fault, "--force");
        EXPECT_LT(watch.seconds(), longest);
        EXPECT_EQ(answer.code, 4) << answer.err;
        EXPECT_SAYS(answer.err, std::string(words) + "scripted trouble\n");
        expect_nothing_left();
    }
}

// limits.start: before MPI_Init nobody can be asked.
TEST_F(FailingFluid, AProgramThatNeverJoinsEndsTheJob) {
    const Stopwatch watch;
    const Answer answer = run_with("early-hang", "--set limits.start=3");
    EXPECT_LT(watch.seconds(), 3.0 + longest);
    EXPECT_EQ(answer.code, 5) << answer.err;
    EXPECT_SAYS(answer.err, "The run failed: nothing from fluid rank 0 (");
    EXPECT_SAYS(answer.err, " within limits.start = 3 s: it has not called MPI_Init\n");
    EXPECT_EQ(count(answer.err, "nor from"), 0) << "the grains wait in MPI_Init\n" << answer.err;
    expect_nothing_left();
}

// Nothing can be lost yet, so the first signal is enough.
TEST_F(FailingFluid, TheFirstSignalEndsARunThatHasNotBegun) {
    setenv("TURBIDITE_FAULT", "early-hang", 1);
    const pid_t run = start(-1, "", (scratch.path() / "bin/turbidite").string());
    unsetenv("TURBIDITE_FAULT");
    while (processes("turbidite-fluid").empty())
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const Stopwatch watch;
    kill(run, SIGTERM);
    const Answer answer = end_of(run);
    EXPECT_LT(watch.seconds(), longest);
    EXPECT_EQ(answer.code, 143);
    EXPECT_SAYS(answer.err, "stopped on request before the first window");
    expect_nothing_left();
}

}  // namespace
}  // namespace turbidite
