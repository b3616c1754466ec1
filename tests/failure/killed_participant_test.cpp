// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Each program of a run is killed without a message, as when memory runs out.
#include "tests/failure/failing_run.hpp"

namespace turbidite {
namespace {

struct Victim {
    const char* program;
    const char* name;
};
class KilledParticipant : public FailingRun, public ::testing::WithParamInterface<Victim> {};

TEST_P(KilledParticipant, IsNamedAndNothingIsLeft) {
    const pid_t run = start(4);
    const auto victim = processes(GetParam().program);
    ASSERT_EQ(victim.size(), 1u);
    kill(victim[0], SIGKILL);
    const Answer answer = end_of(run);
    EXPECT_EQ(answer.code, 4);
    EXPECT_SAYS(answer.err, std::string("The run failed: ") + GetParam().name);
    expect_nothing_left();
    expect_good_output_is_kept(ExitCode::participant_failed);
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

// A batch system kills `turbidite` itself.
TEST_F(FailingRun, KilledTurbiditeLeavesNoJobBehind) {
    const pid_t run = start(4);
    kill(run, SIGKILL);
    EXPECT_EQ(end_of(run).code, 128 + SIGKILL);
    expect_nothing_left();
}

}  // namespace
}  // namespace turbidite
