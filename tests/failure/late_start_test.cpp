// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A program that neither joins the job nor ends: the others wait for it in MPI_Init, in the split
// of the world, or for its first message. It is named, with the step that it has not taken.
#include "tests/failure/failing_run.hpp"

namespace turbidite {
namespace {

constexpr double limit = 4.0;     // [s] limits.start, and limits.stall_hard for the hello
constexpr double longest = 10.0;  // [s] from there to the end of the job

struct Start {
    const char* name;
    const char* program;
    const char* command;
    const char* missing;
};

class LateStart : public FailingRun {
 protected:
    Answer run_with(const std::string& command, const std::string& options = "") const {
        return shell("timeout -s KILL 60 " TURBIDITE_PROGRAM " run small.yaml" + into_run_folder() +
                     " --set limits.start=4 --set limits.stall_hard=4"
                     " --set grains.adapter=external --set \"grains.command=" +
                     command + "\" " + options);
    }
    std::string log() const { return (run_folder() / "logs/grains.log").string(); }
};

class LateStep : public LateStart, public ::testing::WithParamInterface<Start> {};

TEST_P(LateStep, EndsTheJobAndIsNamedOnce) {
    const auto begin = std::chrono::steady_clock::now();
    const Answer answer = run_with(GetParam().command);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    EXPECT_GT(seconds.count(), limit);
    EXPECT_LT(seconds.count(), limit + longest);
    EXPECT_EQ(answer.code, 5) << answer.out << answer.err;
    const std::string named = std::string(" from grains rank 0 (") + GetParam().program;
    EXPECT_SAYS(answer.err, named);
    EXPECT_EQ(answer.err.find(named), answer.err.rfind(named)) << answer.err;
    EXPECT_SAYS(answer.err, ", host ");
    EXPECT_SAYS(answer.err, "log " + log() + ")");
    EXPECT_SAYS(answer.err, GetParam().missing);
    EXPECT_EQ(answer.err.find("nor from"), std::string::npos) << answer.err;
    EXPECT_SAYS(answer.err, "Last lines of logs/grains.log:\n    no further than ");
    EXPECT_EQ(record().at("exit_code"), 5);
    expect_nothing_left();
}

INSTANTIATE_TEST_SUITE_P(
    Steps, LateStep,
    ::testing::Values(Start{"NoMpi", "sh, ", "sh -c 'echo no further than here; sleep 1000'",
                            "it has not called MPI_Init"},
                      Start{"Init", LATECOMER, LATECOMER " init",
                            "it has called MPI_Init, but has not taken part in the split"},
                      Start{"Split", LATECOMER, LATECOMER " split",
                            "it has taken part in the split of MPI_COMM_WORLD, but has not "
                            "announced itself to the coupler"},
                      Start{"Announcement", "latecomer, ", LATECOMER " announcement",
                            "is due to send \"hello\" at the start"}),
    [](const auto& info) { return std::string(info.param.name); });

// It waits in MPI_Finalize for those who wait for it: nobody has to wait for limits.start.
TEST_F(LateStart, AProgramThatLeavesInsteadOfJoiningEndsTheJobAtOnce) {
    const auto begin = std::chrono::steady_clock::now();
    const Answer answer = run_with(LATECOMER " leave", "--set limits.start=100");
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    EXPECT_LT(seconds.count(), 50.0);
    EXPECT_EQ(answer.code, 4) << answer.out << answer.err;
    EXPECT_SAYS(answer.err, "grains rank 0 (" LATECOMER);
    EXPECT_SAYS(answer.err, "has left MPI (MPI_Finalize) without joining the run");
    EXPECT_SAYS(answer.err, "Last lines of logs/grains.log:\n    no further than leave");
    EXPECT_EQ(record().at("exit_code"), 4);
    expect_nothing_left();
}

// Of several ranks all are named, and no rank of another program.
TEST_F(LateStart, AllRanksThatDoNotJoinAreNamed) {
    const Answer answer = run_with(LATECOMER " init", "--set grains.ranks=2");
    EXPECT_EQ(answer.code, 5) << answer.out << answer.err;
    EXPECT_SAYS(answer.err, "nothing from grains rank 0 (");
    EXPECT_SAYS(answer.err, "\n  nor from grains rank 1 (");
    EXPECT_SAYS(answer.err, "logs/grains.rank1.log)");
    EXPECT_EQ(answer.err.find("from fluid"), std::string::npos) << answer.err;
    expect_nothing_left();
}

// Nobody is there to notice it but the launcher.
TEST_F(LateStart, AnMpirunThatStartsNothingIsKilled) {
    scratch.write("mpirun", "#!/bin/sh\nexec sleep 1000\n");
    std::filesystem::permissions(scratch.path() / "mpirun", std::filesystem::perms::owner_all);
    const Answer answer =
        shell("PATH=$PWD:$PATH timeout -s KILL 60 " TURBIDITE_PROGRAM " run small.yaml" +
              into_run_folder() + " --set limits.start=4");
    EXPECT_EQ(answer.code, 5) << answer.out << answer.err;
    EXPECT_SAYS(answer.err, "mpirun has started no program of the job within limits.start");
    EXPECT_EQ(record().at("exit_code"), 5);
}

}  // namespace
}  // namespace turbidite
