// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite adapter-test: the shipped programs conform, and of every requirement there is a program
// that does not meet it and is told so.
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

class AdapterTest : public ShellTest {
 protected:
    Answer judge(const std::string& candidate) const {
        return shell(std::string("timeout 390 ") + TURBIDITE_PROGRAM + " adapter-test " +
                     candidate);
    }
};

class ShippedAdapter : public AdapterTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(ShippedAdapter, Conforms) {
    const std::string name = GetParam();
    const Answer answer = judge("--adapter " + name);
    EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, "\nconforms\n");
    for (const char* requirement :
         {"falls freely without a fluid", "settles in a linear drag (split)",
          "lands and comes to rest", "collides and keeps momentum", "announces grains that leave",
          "refuses messages out of order", "ends in order on a stop request", "repeats itself",
          "goes on from a checkpoint"})
        EXPECT_SAYS(answer.out, std::string("ok    ") + requirement);
    const bool springs = name.ends_with("-md"), ranks = name == "lammps-md";
    const auto grade = [](bool can) { return std::string(can ? "ok    " : "-     "); };
    EXPECT_SAYS(answer.out, grade(!springs) + "uses the fluid's inertia");
    EXPECT_SAYS(answer.out, grade(springs) + "repeats a window");
    EXPECT_SAYS(answer.out, grade(ranks) + "moves the same on two ranks");
    if (!ranks) return;
    EXPECT_SAYS(answer.out, ", 2 grains changed their rank");
}

INSTANTIATE_TEST_SUITE_P(Adapters, ShippedAdapter,
                         ::testing::Values("standalone-nscd", "yade-nscd", "yade-md", "lammps-md",
                                           "standalone-md"),
                         [](const auto& info) {
                             std::string name = info.param;
                             name[name.find('-')] = '_';
                             return name;
                         });

TEST_F(AdapterTest, TheShippedFluidConforms) {
    const Answer answer = judge("--side fluid");
    EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, "\nconforms\n");
    EXPECT_EQ(answer.out.find("-     "), std::string::npos) << answer.out;
}

/// Grains or a fluid with one fault, and the requirement that it does not meet.
struct BrokenProgram {
    const char* name;
    const char* command;
    const char* requirement;
    const char* says;
};
void PrintTo(const BrokenProgram& program, std::ostream* out) {
    *out << program.name;
}

class Broken : public AdapterTest, public ::testing::WithParamInterface<BrokenProgram> {};

TEST_P(Broken, IsTold) {
    const BrokenProgram& program = GetParam();
    const std::string side =
        std::string(program.command).find("fluid") != std::string::npos ? "--side fluid " : "";
    const Answer answer =
        judge(side + "--only '" + program.requirement + "' -- " BROKEN_PROGRAMS + program.command);
    EXPECT_EQ(answer.code, 1) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, std::string("FAILS ") + program.requirement);
    EXPECT_SAYS(answer.out, program.says);
    EXPECT_SAYS(answer.out, "1 requirement is not met");
}

INSTANTIATE_TEST_SUITE_P(
    Grains, Broken,
    ::testing::Values(
        BrokenProgram{"Heavy", "broken-grains heavy", "falls freely", "velocity differs"},
        BrokenProgram{"Deaf", "broken-grains deaf", "settles in a linear drag",
                      "velocities of the state must be those of the kicks"},
        BrokenProgram{"OwnInertia", "broken-grains 'own inertia'", "uses the",
                      "the responses are not taken"},
        BrokenProgram{"NeverGoesBack", "broken-grains 'never goes back'", "repeats a window",
                      "does not go back to t^n"},
        BrokenProgram{"NoFloor", "careless grains", "lands and comes", "sink into the floor"},
        BrokenProgram{"NoContacts", "broken-grains none", "collides", "two grains that met"},
        BrokenProgram{"WrongImpulseDry", "broken-grains 'wrong impulse'", "collides",
                      "M dU = M g dt + J_c fails most for grain"},
        BrokenProgram{"WrongImpulseInTheState", "broken-grains 'wrong impulse'", "lands and comes",
                      "its contact impulses those of the motion"},
        BrokenProgram{"KeepsAll", "broken-grains none", "announces grains", "3 grains at the end"},
        BrokenProgram{"DeafRank", "broken-grains 'second rank is deaf'", "moves the same",
                      "velocities of the state must be those of the kicks"},
        BrokenProgram{"Careless", "careless grains", "refuses messages",
                      "\"kick\" was left out and the program did not mind"},
        BrokenProgram{"FailsAtTheEnd", "broken-grains 'fails at the end'", "ends in order",
                      "no more windows"},
        BrokenProgram{"Noisy", "broken-grains noisy", "repeats itself", "differs between two"},
        BrokenProgram{"ForgetsDigits", "broken-grains 'forgets digits'", "goes on from",
                      "mean_position_x differs from that of a run in one part"}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Fluids, Broken,
    ::testing::Values(
        BrokenProgram{"NoAddedMass", "broken-fluid none", "starts like", "potential flow"},
        BrokenProgram{"Wind", "broken-fluid wind", "keeps the symmetry",
                      "velocity across the axis of symmetry differs"},
        BrokenProgram{"WrongImpulse", "broken-fluid 'wrong impulse'", "balances momentum",
                      "grain_balance"},
        BrokenProgram{"MovesAll", "broken-fluid 'moves all'", "respects a given",
                      "a grain that is driven with 0.5 u_c"},
        BrokenProgram{"WrongResponse", "broken-fluid 'wrong response'", "answers with",
                      "the motion under joint and split differs"},
        BrokenProgram{"WantsAllGrains", "broken-fluid 'wants all grains'", "lets grains",
                      "a grain is gone"},
        BrokenProgram{"WindyRank", "broken-fluid 'second rank is windy'", "moves the same",
                      "the motion on two ranks differs"},
        BrokenProgram{"Careless", "careless fluid", "refuses messages",
                      "\"constraint\" was left out and the program did not mind"},
        BrokenProgram{"FailsAtTheEnd", "broken-fluid 'fails at the end'", "ends in order",
                      "no more windows"},
        BrokenProgram{"Noisy", "broken-fluid noisy", "repeats itself", "differs between two"},
        BrokenProgram{"Forgets", "broken-fluid forgets", "goes on from", "in one part"}),
    [](const auto& info) { return info.param.name; });

// The log goes with the temporary folder.
TEST_F(AdapterTest, ShowsTheLogOfAProgramThatDoesNotStart) {
    const Answer answer = judge("--only 'falls freely' -- /usr/bin/python3 -c 'def 1'");
    EXPECT_EQ(answer.code, 1);
    EXPECT_SAYS(answer.out, "grains rank 0 ended with status 1");
    EXPECT_SAYS(answer.out, "SyntaxError");
}

TEST_F(AdapterTest, NeedsAProgramThatIsThere) {
    EXPECT_EQ(judge("").code, 2);
    EXPECT_SAYS(judge("-- no-such-program").err, "no executable program no-such-program");
    EXPECT_SAYS(judge("--side fluid -- no-such-program").err,
                "no executable program no-such-program");
    EXPECT_SAYS(judge("--adapter nonsense").err, "nonsense");
    EXPECT_EQ(judge("--adapter nonsense").code, 2);
    const Answer none = judge("--adapter standalone-nscd --only flies");
    EXPECT_EQ(none.code, 2);
    EXPECT_SAYS(none.err, "has no requirement \"flies\"; there are\n  falls freely");
}

}  // namespace
}  // namespace turbidite
