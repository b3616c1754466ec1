// SPDX-License-Identifier: GPL-3.0-or-later
//
// YADE leaves a finished run although an engine of the user's script is still at work on the last
// step.
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
        std::string script = slow_engine;
        script.replace(script.find("FOLDER"), 6, scratch.path().string());
        scratch.write("mine.py", script);
    }

    long steps_of_the_engine() const {
        const std::string steps = text(scratch.path() / "steps.txt");
        return std::count(steps.begin(), steps.end(), '\n');
    }
};

// Three windows; the step after them finds the run over, and its engine works all the same.
// SIGKILL, since the first SIGTERM would only ask a hanging run to stop.
TEST_F(ScriptAtTheEnd, LetsTheRunEnd) {
    const Answer answer =
        shell("timeout -s KILL 40 " TURBIDITE_PROGRAM " run small.yaml" + into_run_folder() +
              " --set grains.adapter=yade-nscd --set grains.script=mine.py"
              " --set time.end=0.15");
    EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, "Done.");
    EXPECT_EQ(record().at("windows_done"), 3);
    EXPECT_EQ(steps_of_the_engine(), 4);
    expect_nothing_left();
}

}  // namespace
}  // namespace turbidite
