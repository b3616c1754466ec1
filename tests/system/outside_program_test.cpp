// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A grains program of somebody else that is wrong about itself: whether its state is on the disk,
// and in which letters it speaks. It runs without a fluid, a window in less than a millisecond.
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

/// Grains that fall freely. `lies` after so many states: their checksums are told wrongly from then
/// on. `bytes`: gives up in window 3 with bytes that are no UTF-8. `colours`: with letters for a
/// terminal. `taken`: somebody else has its doorbell. `ranks`: they count their grains together.
/// `typo`: an error before it joins. `elsewhere`: takes another folder for that of the run.
/// `zeros`: returns a number where its state is asked for.
const char* const free_fall = R"(import os, socket, sys
if sys.argv[1] == 'taken':
    thief = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    thief.bind('\0turbidite/' + os.environ['PMIX_NAMESPACE'] + '/' + os.environ['OMPI_COMM_WORLD_RANK'])
    if len(sys.argv) > 3:
        thief.set_inheritable(True)
        os.execv(sys.argv[2], sys.argv[2:])
on_the_wire = sys.argv[1] in ('lies', 'bytes')
turbidite = __import__('wire_adapter' if on_the_wire else 'turbidite_adapter')
from falling import Falling

class Mine(Falling):
    name = 'mine'
    def advance(self, window, responses):
        if window.index == 3 and sys.argv[1] in ('bytes', 'colours'):
            raise ValueError('\033[31mred\007')
        if window.index == 3 and sys.argv[1] == 'ranks':
            print(self.comm.allreduce(len(self.grains)), 'grains on', self.comm.size, 'ranks', flush=True)
        return super().advance(window, responses)
    def save(self):
        return 5 if sys.argv[1] == 'zeros' else super().save()

if sys.argv[1] == 'typo':
    turbidite.run_grain(Mine(turbidite), sys.argv[-1])
if sys.argv[1] == 'elsewhere':
    turbidite.run_grains(Mine(turbidite), '/tmp')
if on_the_wire:
    class Lying(turbidite.Run):
        states = 0
        def checksum(self, state):
            self.states += 1
            return super().checksum(state) ^ (sys.argv[1] == 'lies' and self.states > int(sys.argv[2]))
        def reason(self, error):
            return b'ev\xe9nement' if sys.argv[1] == 'bytes' else super().reason(error)
    turbidite.run_grains(Mine(turbidite), sys.argv[-1], run=Lying)
turbidite.run_grains(Mine(turbidite), sys.argv[-1])
)";

class OutsideProgram : public ShellTest {
 protected:
    void SetUp() override {
        with_python_of_tests();
        scratch.write("mine.py", free_fall);
        scratch.write(
            "fall.yaml",
            "domain: {size: [8, 40]}\n"
            "grains: {adapter: external, command: /usr/bin/python3 mine.py honest, count: 6}\n"
            "fluid: {enabled: false}\n"
            "time: {step: 0.01, end: 0.5}\n"
            "output: {interval: 0.05}\n"
            "checkpoint: {windows: 10, keep: 2}\n"
            "limits: {penetration: 10, stall_soft: 5, stall_hard: 20}\n");
    }

    Answer run(const std::string& how, const std::string& more = "") const {
        return shell("timeout 60 " TURBIDITE_PROGRAM
                     " run fall.yaml --out run --force --set "
                     "'grains.command=/usr/bin/python3 mine.py " +
                     how + "' " + more);
    }
    Answer resume(const std::string& options = "") const {
        return shell("timeout 60 " TURBIDITE_PROGRAM " resume run " + options);
    }
    std::vector<std::string> sets() const {
        std::vector<std::string> names;
        std::error_code none;
        for (const auto& set : fs::directory_iterator(run_folder() / "checkpoints", none))
            names.push_back(set.path().filename());
        std::sort(names.begin(), names.end());
        return names;
    }
};

using Names = std::vector<std::string>;

TEST_F(OutsideProgram, StatesThatAreNotWhatItSaysTakeNoGoodOnesAway) {
    const Answer answer = run("lies 2");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_SAYS(answer.out, "warning: no checkpoint after window 50: grains rank 0: ");
    EXPECT_SAYS(answer.out, "grains.rank0 is damaged: its checksum differs");
    EXPECT_SAYS(answer.out, "The last one is checkpoints/w00000010.");
    EXPECT_EQ(sets(), (Names{"w00000000", "w00000010"}));
    EXPECT_EQ(record().at("checkpoints").at("written"), 2);
    const Answer done = resume();
    EXPECT_EQ(done.code, 0) << done.err;
    EXPECT_SAYS(done.out, "is complete");
    const auto whole = lines_of_history("run");
    // Its first two states are good in every part of the run.
    const Answer on = resume("--set time.end=0.6 --set checkpoint.keep=3");
    EXPECT_EQ(on.code, 0) << on.err;
    EXPECT_SAYS(on.out, "goes on after window 10, 0.1 t_c");
    EXPECT_EQ(sets(), (Names{"w00000010", "w00000020", "w00000030"}));
    const auto longer = lines_of_history("run");
    ASSERT_EQ(longer.size(), whole.size() + 2);
    EXPECT_TRUE(std::equal(whole.begin(), whole.end(), longer.begin()));
}

TEST_F(OutsideProgram, WithoutAGoodStateNothingIsLostByResuming) {
    const Answer answer = run("lies 0");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_SAYS(answer.out, "There is none yet.");
    EXPECT_TRUE(sets().empty());
    const std::string history = text(run_folder() / "history.csv");
    EXPECT_SAYS(resume().out, "is complete");
    const Answer longer = resume("--set time.end=0.6");
    EXPECT_EQ(longer.code, 2) << longer.out;
    EXPECT_SAYS(longer.err, "has windows that are done, but no checkpoint to go on from");
    EXPECT_EQ(text(run_folder() / "history.csv"), history);
}

TEST_F(OutsideProgram, ARunThatWasKilledAfterItsLastCheckpointIsRecordedAsDone) {
    ASSERT_EQ(run("honest").code, 0);
    const auto whole = lines_of_history("run");
    nlohmann::json killed = record();
    killed["status"] = "prepared", killed["exit_code"] = nullptr;
    scratch.write("run/run.json", killed.dump());
    const Answer answer = resume();
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_EQ(record().at("status"), "done");
    EXPECT_EQ(record().at("windows_done"), 50);
    EXPECT_EQ(lines_of_history("run"), whole);
}

TEST_F(OutsideProgram, BytesThatAreNoTextKeepErrorCodeAndRecord) {
    const Answer answer = run("bytes");
    EXPECT_EQ(answer.code, 4) << answer.out << answer.err;
    EXPECT_SAYS(answer.err, "ev\ufffdnement");
    EXPECT_EQ(record().at("exit_code"), 4);
    EXPECT_SAYS(record().at("error").get<std::string>(), "ev\ufffdnement");
    EXPECT_EQ(record().at("windows_done"), 3);
}

TEST_F(OutsideProgram, ControlCharactersDoNotReachTheTerminal) {
    const Answer answer = run("colours");
    EXPECT_EQ(answer.code, 4) << answer.out << answer.err;
    EXPECT_SAYS(answer.err, "ValueError: \ufffd[31mred\ufffd");
    EXPECT_SAYS(answer.err, "Last lines of logs/grains.log");
    for (const char letter : {'\033', '\007'})
        EXPECT_EQ((answer.out + answer.err).find(letter), std::string::npos) << answer.err;
}

TEST_F(OutsideProgram, RanksOfAPythonAdapterTalkToEachOther) {
    ASSERT_EQ(run("ranks").code, 0);
    const auto of_one = lines_of_history("run");
    const Answer answer = run("ranks", "--set grains.ranks=2");
    EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
    for (const char* log : {"logs/grains.rank0.log", "logs/grains.rank1.log"})
        EXPECT_SAYS(text(run_folder() / log), "6 grains on 2 ranks");
    EXPECT_EQ(lines_of_history("run"), of_one);
}

TEST_F(OutsideProgram, AnErrorBeforeItJoinsEndsTheJobAtOnce) {
    const Answer answer = run("typo");
    EXPECT_EQ(answer.code, 4) << answer.out << answer.err;
    EXPECT_SAYS(answer.err, "has no attribute 'run_grain'");
    EXPECT_EQ(answer.err.find("limits.start"), std::string::npos) << answer.err;
}

TEST_F(OutsideProgram, AFolderThatIsNoneOfARunIsRefused) {
    const Answer answer = run("elsewhere");
    EXPECT_EQ(answer.code, 4) << answer.out << answer.err;
    EXPECT_SAYS(answer.err, "\"/tmp\" is no run folder, it has no case.yaml");
}

TEST_F(OutsideProgram, StartedByHandItTouchesNothing) {
    ASSERT_EQ(run("honest").code, 0);
    scratch.write("run/logs/grains.log", "what it said");
    for (const char* mpirun : {"", "mpirun --allow-run-as-root --oversubscribe -n 2 "}) {
        const Answer answer = shell(
            std::string("export PYTHONPATH=$PYTHONPATH:" TURBIDITE_BUILD_DIR "/lib/python; ") +
            "timeout 60 " + mpirun + "/usr/bin/python3 mine.py honest run");
        EXPECT_EQ(answer.code, 2) << answer.out << answer.err;
        EXPECT_SAYS(answer.err, "there is no coupler in this job: programs that play the grains");
    }
    EXPECT_EQ(text(run_folder() / "logs/grains.log"), "what it said");
    EXPECT_FALSE(fs::exists(run_folder() / "logs/grains.rank0.log"));
}

// Python reads a state on as many ranks as wrote it. The command that is printed then works.
TEST_F(OutsideProgram, ValuesThatItCannotGoOnWithAreTakenBack) {
    ASSERT_EQ(run("honest").code, 0);
    const std::string before = text(run_folder() / "case.yaml");
    const Answer refused = resume("--set time.end=0.6 --set grains.ranks=2");
    EXPECT_EQ(refused.code, 4) << refused.out << refused.err;
    EXPECT_SAYS(refused.err, "No window is left that was played with time.end=0.6, grains.ranks=2");
    EXPECT_EQ(text(run_folder() / "case.yaml"), before);
    // Nor does the record say that there were windows with them.
    EXPECT_EQ(record()["parts"].back()["overrides"].size(), 0u);
    EXPECT_EQ(record()["parts"].back()["refused_overrides"].size(), 2u);
    EXPECT_EQ(record()["windows"], 50);
    const Answer on = resume("--set time.end=0.6");
    EXPECT_EQ(on.code, 0) << on.out << on.err;
    EXPECT_SAYS(on.out, "goes on after window 50");
    EXPECT_EQ(record().at("windows_done"), 60);
}

TEST_F(OutsideProgram, ANumberIsNoState) {
    const Answer answer = run("zeros");
    EXPECT_SAYS(answer.out + answer.err, "no checkpoint after window 10");
    EXPECT_TRUE(sets().empty());
}

// Another user of the host may take the name of a doorbell first. It costs time, and is told.
TEST_F(OutsideProgram, ADoorbellThatIsTakenIsTold) {
    const std::string warning = "turbidite: warning: another process has the doorbell ";
    const Answer python = run("taken");
    EXPECT_EQ(python.code, 0) << python.err;
    EXPECT_SAYS(text(run_folder() / "logs/grains.log"), warning);
    const Answer cpp = run("taken " TURBIDITE_BUILD_DIR "/bin/turbidite-grains");
    EXPECT_EQ(cpp.code, 0) << cpp.err;
    EXPECT_SAYS(text(run_folder() / "logs/grains.log"), warning);
    ASSERT_EQ(run("honest").code, 0);
    EXPECT_EQ(text(run_folder() / "logs/grains.log").find(warning), std::string::npos);
}

}  // namespace
}  // namespace turbidite
