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

    /// Of an adapter in Python with these members, besides name, version and host_code.
    Answer judge_python(const std::string& options, const std::string& members) const {
        scratch.write("mine.py",
                      "import sys, turbidite_adapter as turbidite\n"
                      "class Mine:\n"
                      "    name, version, host_code = 'mine', '1', 'Python'\n" +
                          members + "turbidite.run_grains(Mine(), sys.argv[-1])\n");
        return judge(options + " -- /usr/bin/python3 mine.py");
    }
};

class ShippedAdapter : public AdapterTest, public ::testing::WithParamInterface<const char*> {
 protected:
    void expect_to_conform(const Answer& answer, bool on_ranks) const {
        EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
        EXPECT_SAYS(answer.out, "\nconforms\n");
        for (const char* requirement :
             {"falls freely without a fluid", "settles in a linear drag (split)",
              "lands and comes to rest", "collides and keeps momentum", "slides into rolling",
              "collides with friction", "reports its contacts", "announces grains that leave",
              "refuses messages out of order", "ends in order on a stop request", "repeats itself",
              "goes on from a checkpoint"})
            EXPECT_SAYS(answer.out, std::string("ok    ") + requirement);
        const bool springs = std::string(GetParam()).ends_with("-md");
        const auto grade = [](bool can) { return std::string(can ? "ok    " : "-     "); };
        EXPECT_SAYS(answer.out, grade(!springs) + "uses the fluid's inertia");
        EXPECT_SAYS(answer.out, grade(springs) + "repeats a window");
        EXPECT_SAYS(answer.out, grade(!springs) + "respects held and driven grains");
        EXPECT_SAYS(answer.out, grade(on_ranks) + "moves the same on two ranks");
        if (!on_ranks) return;
        EXPECT_SAYS(answer.out, " grains changed their rank");
        EXPECT_EQ(answer.out.find(" 0 grains changed"), std::string::npos) << answer.out;
    }
};

bool runs_on_ranks(const std::string& adapter) {
    return adapter == "lammps-md" || adapter == "standalone-nscd";
}

TEST_P(ShippedAdapter, Conforms) {
    const std::string name = GetParam();
    expect_to_conform(judge("--adapter " + name), runs_on_ranks(name));
}

using ShippedAdapterInSpace = ShippedAdapter;

TEST_P(ShippedAdapterInSpace, Conforms) {
    const std::string name = GetParam();
    expect_to_conform(judge("--dimension 3 --adapter " + name), runs_on_ranks(name));
}

// What the dimension changes: the liquid's kick, and contacts.
TEST_F(AdapterTest, HostsInYadeConformInSpace) {
    for (const std::string name : {"yade-nscd", "yade-md"}) {
        const std::string program = "--dimension 3 --adapter " + name;
        const Answer wet = judge(program + " --only '('");
        EXPECT_EQ(wet.code, 0) << wet.out << wet.err;
        EXPECT_SAYS(wet.out, "ok    settles in a linear drag");
        const Answer contacts = judge(program + " --only co");
        EXPECT_EQ(contacts.code, 0) << contacts.out << contacts.err;
        EXPECT_SAYS(contacts.out, "ok    collides with friction");
    }
}

std::string name_of(const ::testing::TestParamInfo<const char*>& info) {
    std::string name = info.param;
    name[name.find('-')] = '_';
    return name;
}
const auto shipped =
    ::testing::Values("standalone-nscd", "yade-nscd", "yade-md", "lammps-md", "standalone-md");
INSTANTIATE_TEST_SUITE_P(Adapters, ShippedAdapter, shipped, name_of);
INSTANTIATE_TEST_SUITE_P(Adapters, ShippedAdapterInSpace,
                         ::testing::Values("standalone-nscd", "lammps-md", "standalone-md"),
                         name_of);

TEST_F(AdapterTest, TheShippedFluidConforms) {
    const Answer answer = judge("--side fluid");
    EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, "\nconforms\n");
    EXPECT_EQ(answer.out.find("-     "), std::string::npos) << answer.out;
}

TEST_F(AdapterTest, TheShippedFluidsConformInSpace) {
    for (const char* fluid : {"openfoam", "box"}) {
        const Answer answer = judge(std::string("--side fluid --dimension 3 --adapter ") + fluid);
        EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
        EXPECT_SAYS(answer.out, "\nconforms\n");
        EXPECT_EQ(answer.out.find("-     "), std::string::npos) << answer.out;
    }
    EXPECT_SAYS(judge("--side fluid --adapter box").err, "add --dimension 3");
    EXPECT_SAYS(judge("--side fluid --adapter boxes").err, "there are openfoam and box");
    EXPECT_SAYS(judge("--adapter openfoam").err, "plays the fluid openfoam with --side fluid");
    EXPECT_SAYS(judge("--adapter yade-ncsd").err, "Do you mean yade-nscd?");
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
        BrokenProgram{"OneSinks", "contact-grains 'one sinks'", "lands and comes",
                      "grains sink into the floor: grain 8 is at 0.38 D"},
        BrokenProgram{"HighFloor", "contact-grains 'high floor'", "lands and comes",
                      "grains stay above the floor: grain "},
        BrokenProgram{"GoesHalf", "contact-grains 'goes half'", "falls freely",
                      "from where its velocity"},
        BrokenProgram{"NeverRests", "contact-grains 'never rests'", "lands and comes",
                      "grains are not at rest: mean speed 0.09"},
        BrokenProgram{"NoContacts", "broken-grains none", "collides and", "two grains that met"},
        BrokenProgram{"Soft", "contact-grains soft", "collides and", "grains overlap by 0.1 D"},
        BrokenProgram{"HidesOverlap", "contact-grains 'hides overlap'", "collides and",
                      "and max_penetration says 0 D"},
        BrokenProgram{"HidesOverlapWithAWall", "contact-grains 'hides overlap'", "lands and comes",
                      "and max_penetration says 0 D"},
        BrokenProgram{"OneSided", "contact-grains one-sided", "collides and",
                      "momentum along the contact differs"},
        BrokenProgram{"Slippery", "contact-grains slippery", "slides into",
                      "velocity of a grain that slides differs"},
        BrokenProgram{"Rough", "contact-grains rough", "slides into",
                      "the tangential impulse is 0.6 of the normal one"},
        BrokenProgram{"NoSpin", "contact-grains 'no spin'", "slides into",
                      "velocity of a grain that slides differs"},
        BrokenProgram{"SlipsPast", "contact-grains slippery", "collides with",
                      "friction over normal impulse of two grains that slip differs"},
        BrokenProgram{"RoughPair", "contact-grains rough", "collides with",
                      "the tangential impulse is 0.24 of the normal one"},
        BrokenProgram{"OneSpin", "contact-grains 'one spin'", "collides with",
                      "angular momentum over friction impulse, in D, differs by 5.0e-01"},
        BrokenProgram{"OneSidedFriction", "contact-grains one-sided", "collides with",
                      "momentum of two grains differs"},
        BrokenProgram{"MovesAll", "contact-grains 'moves all'", "respects held", "grain"},
        BrokenProgram{"HalfRecords", "contact-grains 'half records'", "reports its",
                      "the sum of its contacts, in weights, differs by 5.0e-01"},
        BrokenProgram{"NoBranch", "contact-grains 'no branch'", "reports its",
                      "has the branch (0, 0, 0) m, but centre"},
        BrokenProgram{"WrongImpulseDry", "broken-grains 'wrong impulse'", "collides and",
                      "M dU = M g dt + J_c fails most for grain"},
        BrokenProgram{"WrongImpulseInTheState", "broken-grains 'wrong impulse'", "lands and comes",
                      "its contact impulses those of the motion"},
        BrokenProgram{"KeepsAll", "broken-grains none", "announces grains", "3 grains at the end"},
        BrokenProgram{"ExitsWithFreeSides", "contact-grains 'exits with free sides'",
                      "announces grains", "grains rank 0 ended with status 1"},
        BrokenProgram{"CrashesOnTwoRanks", "contact-grains 'crashes on two ranks'",
                      "moves the same", "was ended by signal 6"},
        BrokenProgram{"DeafRank", "broken-grains 'second rank is deaf'", "moves the same",
                      "velocities of the state must be those of the kicks"},
        BrokenProgram{"Careless", "careless grains", "refuses messages",
                      "\"kick\" was left out and the program did not mind"},
        BrokenProgram{"FailsAtTheEnd", "broken-grains 'fails at the end'", "ends in order",
                      "no more windows"},
        BrokenProgram{"Noisy", "broken-grains noisy", "repeats itself", "differs between two"},
        BrokenProgram{"CannotSave", "contact-grains 'cannot save'", "goes on from",
                      "saves_state is claimed and not kept: there is no room for the state"},
        BrokenProgram{"ForgetsDigits", "broken-grains 'forgets digits'", "goes on from",
                      "mean_velocity_x differs from that of a run in one part"},
        BrokenProgram{"ForgetsPlaces", "broken-grains 'forgets places'", "goes on from",
                      "positions and orientations of the start of the window"}),
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
                      "instead of the given (0.5, 0, 0)"},
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

TEST_F(AdapterTest, BrokenInSpace) {
    const Answer answer = judge("--dimension 3 --only 'falls freely' -- " BROKEN_PROGRAMS
                                "broken-grains 'slow across'");
    EXPECT_EQ(answer.code, 1) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, "velocity along z differs by");
    const Answer plane =
        judge("--only 'falls freely' -- " BROKEN_PROGRAMS "broken-grains 'slow across'");
    EXPECT_EQ(plane.code, 0) << plane.out << plane.err;
}

/// A program of another kind than the shipped ones, which refuses in words what it cannot do.
TEST_F(AdapterTest, AnHonestProgramConforms) {
    const Answer honest = judge("-- " BROKEN_PROGRAMS "contact-grains none");
    EXPECT_EQ(honest.code, 0) << honest.out << honest.err;
    EXPECT_SAYS(honest.out, "ok    slides into rolling");
    EXPECT_SAYS(honest.out, "-     announces grains that leave         refuses free sides: ");
    EXPECT_SAYS(honest.out, "-     moves the same on two ranks         refuses two ranks: ");
    EXPECT_SAYS(honest.out, "\nconforms\n");

    const Answer refused =
        judge("--only ction -- " BROKEN_PROGRAMS "contact-grains 'refuses friction'");
    EXPECT_EQ(refused.code, 0) << refused.out << refused.err;
    EXPECT_SAYS(refused.out, "-     collides with friction              refuses friction: ");
    EXPECT_SAYS(refused.out, "no friction: contact.friction");
}

TEST_F(AdapterTest, APythonProgramMayRepeatWindows) {
    with_python_of_tests();
    const Answer answer =
        judge("--only 'repeats a window' -- /usr/bin/python3 " TURBIDITE_SOURCE_DIR
              "/tests/python/falling.py");
    EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, "ok    repeats a window");
}

TEST_F(AdapterTest, AFaultOfADescriptionInPythonIsTold) {
    const Answer answer = judge_python("--dimension 3 --only 'falls freely'",
                                       "    shapes, dimensions = ['sphere'], 3\n"
                                       "    initialise = advance = apply_kick = None\n");
    EXPECT_EQ(answer.code, 1) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, "dimensions = 3; allowed are (2,), (3,) and (2, 3)");
    // Its shapes are not told any more: no reason to say that they do not fit.
    const Answer nameless = judge_python("--dimension 3 --only 'falls freely'",
                                         "    shapes, dimensions = ['sphere'], (3,)\n"
                                         "    initialise = advance = apply_kick = None\n"
                                         "del Mine.version\n");
    EXPECT_EQ(nameless.code, 1) << nameless.out << nameless.err;
    EXPECT_SAYS(nameless.out, "AttributeError: ");
    EXPECT_SAYS(nameless.out, "'version'");
}

// sys.exit in a program in Python is told by the library, not by the program.
TEST_F(AdapterTest, AnExitIsNoRefusal) {
    const Answer answer =
        judge_python("--only friction",
                     "    def initialise(self, settings, shapes, grains): sys.exit(0)\n"
                     "    advance = apply_kick = None\n");
    EXPECT_EQ(answer.code, 1) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, "FAILS collides with friction");
    EXPECT_SAYS(answer.out, "SystemExit: 0");
}

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
    // Which of the two would be judged?
    const Answer both = judge("--adapter standalone-nscd -- no-such-program");
    EXPECT_EQ(both.code, 2);
    EXPECT_SAYS(both.err, "plays the shipped adapter standalone-nscd or a program");
    const Answer none = judge("--adapter standalone-nscd --only flies");
    EXPECT_EQ(none.code, 2);
    EXPECT_SAYS(none.err, "has no requirement \"flies\"; there are\n  falls freely");
}

}  // namespace
}  // namespace turbidite
