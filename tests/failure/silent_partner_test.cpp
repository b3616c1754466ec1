// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A program of a run stops answering: the others must not wait for ever.
#include "tests/failure/failing_fluid.hpp"
#include "tests/failure/stopwatch.hpp"

namespace turbidite {
namespace {

class SilentPartner : public FailingRun, public ::testing::WithParamInterface<const char*> {};

TEST_P(SilentPartner, EndsTheRunWithTheWaitForTable) {
    with_reports();
    const std::string role = GetParam();
    const pid_t run = start(4);
    const auto partner = processes("turbidite-" + role);
    ASSERT_EQ(partner.size(), 1u);
    kill(partner[0], SIGSTOP);
    const Stopwatch watch;
    const Answer answer = end_of(run);
    EXPECT_LT(watch.seconds(), 3.0 + longest_with_report);  // limits.stall_hard
    EXPECT_EQ(answer.code, 5);
    EXPECT_SAYS(answer.out, "still waiting for");  // after limits.stall_soft
    EXPECT_SAYS(answer.err, "from " + role + " rank 0 (");
    EXPECT_SAYS(answer.err, "/logs/" + role + ".log) for 3 s");
    EXPECT_SAYS(answer.err, role + " rank 0 (host ");
    EXPECT_SAYS(answer.err, "is due to send");
    EXPECT_SAYS(answer.err, "waits for the coupler's");
    expect_nothing_left();
    expect_good_output_is_kept(ExitCode::stalled);
    expect_report();
}

INSTANTIATE_TEST_SUITE_P(Roles, SilentPartner, ::testing::Values("fluid", "grains"),
                         [](const auto& info) { return std::string(info.param); });

// It works and works, or has left MPI by itself and waits there for the others.
class BusyPartner : public FailingFluid, public ::testing::WithParamInterface<const char*> {};

TEST_P(BusyPartner, EndsTheRunWithTheWaitForTable) {
    const Stopwatch watch;
    const Answer answer = run_with(GetParam());
    EXPECT_LT(watch.seconds(), 3.0 + longest);  // limits.stall_hard
    EXPECT_EQ(answer.code, 5) << answer.out << answer.err;
    EXPECT_SAYS(answer.err, "no \"kicks\" from fluid rank 0 (");
    EXPECT_SAYS(answer.err, "/logs/fluid.log) for 3 s");
    EXPECT_SAYS(answer.err, "is due to send \"kicks\", window 5, round 1, for 3 s");
    EXPECT_SAYS(answer.err, "grains rank 0 (host ");
    EXPECT_SAYS(answer.err, "waits for the coupler's");
    expect_nothing_left();
    expect_good_output_is_kept(ExitCode::stalled);
}

INSTANTIATE_TEST_SUITE_P(Ways, BusyPartner, ::testing::Values("loop", "finalize"),
                         [](const auto& info) { return std::string(info.param); });

// Nobody is silent for limits.stall_hard, and the grains hear nothing for longer than one and a
// half of it: they wait for two answers of the fluid.
TEST_F(FailingFluid, MayBeWaitedForTwiceInAWindow) {
    const Answer answer = run_with("late-twice", "--set coupling.scheme=joint --set time.end=0.5");
    EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, "still waiting for \"response\" from fluid after 2 s");
    EXPECT_SAYS(answer.out, "still waiting for \"kicks\" from fluid after 2 s");
    EXPECT_EQ(rows_of_history(), 11);
}

// The participants give up after 2.5 times limits.stall_hard; the host code must not hang when it
// exits.
class SilentCoupler : public FailingRun, public ::testing::WithParamInterface<const char*> {};

TEST_P(SilentCoupler, EndsTheParticipants) {
    const pid_t run =
        start(4, std::string("--set limits.stall_hard=2 --set grains.adapter=") + GetParam());
    const auto coupler = processes("turbidite-coupler");
    ASSERT_EQ(coupler.size(), 1u);
    kill(coupler[0], SIGSTOP);
    const Stopwatch watch;
    EXPECT_EQ(end_of(run).code, 5);
    EXPECT_LT(watch.seconds(), 5.0 + longest);
    expect_nothing_left();
    EXPECT_SAYS(text(run_folder() / "logs/fluid.log") + text(run_folder() / "logs/grains.log"),
                "the coupler has been silent for 5 s");
}

INSTANTIATE_TEST_SUITE_P(Adapters, SilentCoupler, ::testing::Values("standalone-nscd", "yade-nscd"),
                         [](const auto& info) {
                             return std::string(info.param) == "yade-nscd" ? "Yade" : "Standalone";
                         });

// As batch systems suspend a job, for longer than any limit: nobody has been silent, all were
// stopped.
class Suspended : public FailingRun {};

TEST_F(Suspended, GoesOnAsIfNothingHadBeen) {
    const pid_t run = start(4, "--set time.end=10 --set limits.stall_hard=2");
    const std::vector<pid_t> all = processes("");
    EXPECT_GE(all.size(), 5u);  // turbidite, mpirun, coupler, fluid, grains
    for (const pid_t process : all) kill(process, SIGSTOP);
    std::this_thread::sleep_for(std::chrono::milliseconds(5500));  // 2.5 limits.stall_hard
    for (const pid_t process : all) kill(process, SIGCONT);
    const Answer answer = end_of(run);
    EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_EQ(rows_of_history(), 201);
}

}  // namespace
}  // namespace turbidite
