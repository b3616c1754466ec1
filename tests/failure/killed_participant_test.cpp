// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Each program of a run is killed without a message, as when memory runs out.
#include "tests/failure/failing_run.hpp"
#include "tests/failure/stopwatch.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

struct Victim {
    const char* program;
    const char* name;
};
class KilledParticipant : public FailingRun, public ::testing::WithParamInterface<Victim> {};

TEST_P(KilledParticipant, IsNamedAndNothingIsLeft) {
    with_reports();
    const pid_t run = start(4);
    const auto victim = processes(GetParam().program);
    ASSERT_EQ(victim.size(), 1u);
    kill(victim[0], SIGKILL);
    const Stopwatch watch;
    const Answer answer = end_of(run);
    EXPECT_LT(watch.seconds(), longest_with_report);
    EXPECT_EQ(answer.code, 4);
    EXPECT_SAYS(answer.err, std::string("The run failed: ") + GetParam().name);
    expect_nothing_left();
    expect_good_output_is_kept(ExitCode::participant_failed);
    EXPECT_EQ(record().at("parts").back().at("status"), "failed");
    expect_report();
}

INSTANTIATE_TEST_SUITE_P(
    EveryProgram, KilledParticipant,
    ::testing::Values(Victim{"turbidite-fluid", "fluid rank 0 was ended by signal 9"},
                      Victim{"turbidite-grains", "grains rank 0 was ended by signal 9"},
                      Victim{"turbidite-coupler", "coupler was ended by signal 9"},
                      Victim{"mpirun", "mpirun ended with status 137"}),
    [](const auto& info) {
        const std::string program = info.param.program;
        return program.substr(program.find('-') + 1);
    });

// Seen with Open MPI 4.1: after a crash mpirun ends its ranks and then waits for itself.
TEST_F(FailingRun, AnMpirunThatStaysAfterACrashIsKilled) {
    const fs::path bin = scratch.path() / "bin", own = bin / "mpirun";
    fs::create_directories(bin);
    scratch.write("bin/mpirun", "#!/bin/sh\nPATH=${PATH#*:}\nmpirun \"$@\"\nexec sleep 1000\n");
    fs::permissions(own, fs::perms::owner_all);
    const pid_t run =
        start(4, "", "env PATH=" + bin.string() + ":$PATH " + std::string(TURBIDITE_PROGRAM));
    for (const pid_t process : processes("turbidite-grains")) kill(process, SIGKILL);
    const Stopwatch watch;
    const Answer answer = end_of(run);
    EXPECT_LT(watch.seconds(), 3.0 + longest);  // limits.stall_hard
    EXPECT_EQ(answer.code, 4);
    EXPECT_SAYS(answer.err, "mpirun has not ended within limits.stall_hard = 3 s and is killed");
    EXPECT_SAYS(answer.err, "The run failed: grains rank 0 was ended by signal 9");
    expect_nothing_left();
    expect_good_output_is_kept(ExitCode::participant_failed);
}

// As an operator would end a job whose `turbidite` is elsewhere: mpirun ends its ranks without a
// word of who it was.
TEST_F(FailingRun, SigTermToMpirunIsTold) {
    const pid_t run = start(4);
    const auto mpirun = processes("mpirun");
    ASSERT_EQ(mpirun.size(), 1u);
    kill(mpirun[0], SIGTERM);
    const Stopwatch watch;
    const Answer answer = end_of(run);
    EXPECT_LT(watch.seconds(), longest);
    EXPECT_EQ(answer.code, 4) << answer.out << answer.err;
    EXPECT_SAYS(answer.err, "The run failed: mpirun ended with status 1 and named no program");
    EXPECT_SAYS(answer.err, "Last lines of logs/coupler.log:");
    expect_nothing_left();
    expect_good_output_is_kept(ExitCode::participant_failed);
}

// A batch system kills `turbidite` itself.
TEST_F(FailingRun, KilledTurbiditeLeavesNoJobBehind) {
    const pid_t run = start(4);
    kill(run, SIGKILL);
    EXPECT_EQ(end_of(run).code, 128 + SIGKILL);
    expect_nothing_left();
}

}  // namespace
}  // namespace turbidite
