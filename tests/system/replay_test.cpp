// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite replay: fluid and grains of a recorded job, each alone.
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

class Replay : public ShellTest {
 protected:
    Answer turbidite(const std::string& arguments) const {
        return shell(std::string(TURBIDITE_PROGRAM) + " " + arguments);
    }
};

TEST_F(Replay, EachSideRepeatsItselfToTheBit) {
    const std::string run = "run " TURBIDITE_SOURCE_DIR
                            "/configs/quickstart.yaml --set time.end=0.5 --set fluid.ranks=2 --out "
                            "run --force";
    ASSERT_EQ(turbidite(run + " --set coupling.recording=both").code, 0);
    for (const std::string side : {"grains", "fluid"}) {
        const Answer answer = turbidite("replay run --side " + side + " --out again-" + side);
        EXPECT_EQ(answer.code, 0) << answer.err;
        EXPECT_NE(answer.out.find("40 windows"), std::string::npos) << answer.out;
        EXPECT_NE(answer.out.find("of the " + side + " compared: identical"), std::string::npos)
            << answer.out;
    }
    const std::string frames = text(run_folder() / "recording/grains.frames");
    EXPECT_FALSE(frames.empty());
    for (const std::string out : {"run", ".", "run/recording/"}) {
        const Answer same = turbidite("replay run --side grains --force --out " + out);
        EXPECT_EQ(same.code, 2) << out;
        EXPECT_SAYS(same.err, "holds the recording itself");
    }
    EXPECT_EQ(text(run_folder() / "recording/grains.frames"), frames);
    EXPECT_EQ(turbidite("replay ''").code, 2);
    EXPECT_FALSE(
        std::filesystem::exists(scratch.path() / "again-grains/fluid/constant/polyMesh/faces"))
        << "the mesh of a recorded fluid";
    const Answer both = turbidite("replay run");
    EXPECT_EQ(both.code, 2);
    EXPECT_NE(both.err.find("--side grains or --side fluid"), std::string::npos) << both.err;

    ASSERT_EQ(turbidite(run).code, 0);  // an old recording would be of another run
    const Answer none = turbidite("replay run");
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.err.find("coupling.recording"), std::string::npos) << none.err;
}

// A program that has changed since: grains that fall a little faster from window 6 on.
TEST_F(Replay, WhatDiffersIsToldAndGivesExitCodeOne) {
    with_python_of_tests();
    const auto write_program = [&](const std::string& extra) {
        scratch.write("mine.py",
                      "import sys, turbidite_adapter\n"
                      "from falling import Falling\n"
                      "class Mine(Falling):\n"
                      "    def advance(self, window, responses):\n"
                      "        self.fall = self.g" +
                          extra +
                          "\n"
                          "        return super().advance(window, responses)\n"
                          "turbidite_adapter.run_grains(Mine(turbidite_adapter), sys.argv[-1])\n");
    };
    write_program("");
    scratch.write("fall.yaml",
                  "domain: {size: [8, 8]}\n"
                  "grains: {adapter: external, command: /usr/bin/python3 mine.py, count: 3}\n"
                  "fluid: {enabled: false}\n"
                  "coupling: {recording: grains}\n"
                  "time: {step: 0.01, end: 0.1}\n"
                  "output: {interval: 0.1}\n");
    const Answer recorded = turbidite("run fall.yaml --out run");
    ASSERT_EQ(recorded.code, 0) << recorded.err;
    EXPECT_EQ(turbidite("replay run --out same").code, 0);

    write_program(" * (1 if window.index < 6 else 1.001)");
    const Answer other = turbidite("replay run --out other");
    EXPECT_EQ(other.code, 1) << other.out << other.err;
    EXPECT_SAYS(other.out, "\"state\" of window 6, rank 0: grain ");
    EXPECT_SAYS(other.out, ": position y = ");
    EXPECT_SAYS(other.out, " instead of ");
    EXPECT_SAYS(other.out, "compared: 4 differ");
    EXPECT_TRUE(std::filesystem::exists(scratch.path() / "other/differences"));
}

TEST_F(Replay, OfAResumedRunBeginsWithItsCheckpoint) {
    const std::string run = "run " TURBIDITE_SOURCE_DIR
                            "/configs/quickstart.yaml --set time.end=0.3 --set "
                            "coupling.recording=both --set checkpoint.keep=1 --out run";
    ASSERT_EQ(turbidite(run).code, 0);
    const Answer resumed = turbidite("resume run --set time.end=0.5");
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    // The run itself has only a newer one.
    EXPECT_FALSE(std::filesystem::exists(run_folder() / "checkpoints/w00000024"));
    for (const std::string side : {"grains", "fluid"}) {
        const Answer second = turbidite("replay run --side " + side + " --out second-" + side);
        EXPECT_EQ(second.code, 0) << second.out << second.err;
        EXPECT_SAYS(second.out, "16 windows");
        EXPECT_SAYS(second.out, "of the " + side + " compared: identical");
        const Answer first = turbidite("replay run --part 1 --side " + side + " --out " + side);
        EXPECT_EQ(first.code, 0) << first.out << first.err;
        EXPECT_SAYS(first.out, "24 windows");
        EXPECT_SAYS(first.out, "of the " + side + " compared: identical");
    }
    EXPECT_SAYS(turbidite("replay run --part 2 --side grains").err, "has no recording/part-2");

    std::filesystem::remove_all(run_folder() / "recording/checkpoints");
    const Answer without = turbidite("replay run --side grains --out without");
    EXPECT_EQ(without.code, 2);
    EXPECT_SAYS(without.err, "begins with a checkpoint that is not there");
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "without"));
}

}  // namespace
}  // namespace turbidite
