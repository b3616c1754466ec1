// SPDX-License-Identifier: GPL-3.0-or-later
//
// YADE leaves a finished run although the user's script is still at work: an engine on the last
// step, or an exit handler.
#include "tests/failure/failing_run.hpp"

namespace turbidite {
namespace {

// YADE's loop runs in a thread of its own, which ends only after all engines of the step. This one
// is still at it when the coupler has dismissed the participant.
constexpr auto slow_engine =
    "import time\n"
    "def linger():\n"
    "    time.sleep(0.3)\n"
    "    with open('FOLDER/steps.txt', 'a') as out:\n"
    "        out.write('%d\\n' % O.iter)\n"
    "O.engines = O.engines + [PyRunner(command='linger()', iterPeriod=1)]\n";

class ScriptAtTheEnd : public FailingRun {
 protected:
    void SetUp() override {
        FailingRun::SetUp();
        setenv("TURBIDITE_REPORT", "off", 1);
    }

    /// Three windows. SIGKILL, since the first SIGTERM would only ask a hanging run to stop.
    Answer run_with(std::string script) const {
        const auto folder = script.find("FOLDER");
        if (folder != std::string::npos) script.replace(folder, 6, scratch.path().string());
        scratch.write("mine.py", script);
        return shell("timeout -s KILL 40 " TURBIDITE_PROGRAM " run small.yaml" + into_run_folder() +
                     " --set grains.adapter=yade-nscd --set grains.script=mine.py"
                     " --set time.end=0.15");
    }

    long steps_of_the_engine() const {
        const std::string steps = text(scratch.path() / "steps.txt");
        return std::count(steps.begin(), steps.end(), '\n');
    }
};

// The step after the last window finds the run over, and its engine works all the same.
TEST_F(ScriptAtTheEnd, LetsTheRunEnd) {
    const Answer answer = run_with(slow_engine);
    EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, "Done.");
    EXPECT_EQ(record().at("windows_done"), 3);
    EXPECT_EQ(steps_of_the_engine(), 4);
    expect_nothing_left();
}

// YADE runs exit handlers of C, and no others. The run is done, and the job ends after
// limits.stall_hard.
TEST_F(ScriptAtTheEnd, ThatStaysIsNamedAndKilled) {
    const Answer answer = run_with(
        "import ctypes, time\n"
        "stay = ctypes.CFUNCTYPE(None)(lambda: time.sleep(1000))\n"
        "ctypes.CDLL(None).__cxa_atexit(stay, None, None)\n");
    EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_SAYS(answer.err, "the run is over, but grains rank 0 (/usr/bin/yade, host ");
    EXPECT_SAYS(answer.err, "logs/grains.log) has not ended within limits.stall_hard = 3 s");
    EXPECT_SAYS(answer.out, "Done.");
    EXPECT_EQ(record().at("windows_done"), 3);
    EXPECT_EQ(record().at("exit_code"), 0);
    expect_nothing_left();
}

}  // namespace
}  // namespace turbidite
