// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The child process: its exit code, its own session, and the effect of signals.
#include "launcher/job/job.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include "coupler/protocol/failure.hpp"
#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {
namespace {

class JobTest : public ::testing::Test {
 protected:
    ScratchFolder scratch;
    int requests = 0;
    bool can_be_asked = true;

    JobEnd run(const std::string& script) {
        return run_job({.arguments = {"sh", "-c", script},
                        .error_log = scratch.path() / "stderr",
                        .request_stop = [this](int) {
                            ++requests;
                            scratch.write("STOP", "");
                            return can_be_asked;
                        }});
    }

    std::string text(const std::string& name) {
        std::ifstream file(scratch.path() / name);
        return {std::istreambuf_iterator<char>(file), {}};
    }
};

void unblock(int signal) {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, signal);
    sigprocmask(SIG_UNBLOCK, &set, nullptr);
}

// Signals are handled by the thread that waits in run_job: this process blocks them everywhere
// else.
class Later {
 public:
    Later(int count, int signal) {
        sigset_t set;
        sigemptyset(&set);
        sigaddset(&set, signal);
        pthread_sigmask(SIG_BLOCK, &set, nullptr);
        thread_ = std::thread([count, signal] {
            for (int i = 0; i < count; ++i) {
                std::this_thread::sleep_for(std::chrono::milliseconds(400));
                kill(getpid(), signal);
            }
        });
    }
    ~Later() { thread_.join(); }

 private:
    std::thread thread_;
};

TEST_F(JobTest, PassesExitCodesOn) {
    EXPECT_EQ(run("exit 0").status, 0);
    EXPECT_EQ(run("exit 6").status, 6);
    EXPECT_EQ(run("kill -9 $$").status, 128 + 9);
}

TEST_F(JobTest, KeepsErrorsInAFile) {
    run("echo oops >&2");
    EXPECT_EQ(text("stderr"), "oops\n");
}

TEST_F(JobTest, RunsInItsOwnSession) {
    // In /proc/PID/stat the session is the fourth field after the name.
    run("awk '{print $6 == $1}' /proc/$$/stat >&2");
    EXPECT_EQ(text("stderr"), "1\n");
}

TEST_F(JobTest, TheFirstSignalKillsAProgramThatCannotBeAsked) {
    can_be_asked = false;
    const Later signal(1, SIGTERM);
    const JobEnd end = run("sleep 60");
    EXPECT_EQ(requests, 1);
    EXPECT_EQ(end.signal, SIGTERM);
    EXPECT_TRUE(end.killed);
    EXPECT_FALSE(end.crashed);
}

TEST_F(JobTest, NamesAProgramThatIsNotThere) {
    try {
        run_job({.arguments = {"turbidite-no-such-program"},
                 .error_log = scratch.path() / "stderr",
                 .request_stop = [](int) { return true; }});
        FAIL() << "a missing program ran";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::participant_failed);
        const std::string text = failure.what();
        EXPECT_NE(text.find("turbidite-no-such-program cannot be started: No such file"),
                  std::string::npos)
            << text;
    }
}

// A shell ends so when it finds no command, and mpirun as the program that ends first.
TEST_F(JobTest, AStatusIsThatOfTheProgram) {
    EXPECT_EQ(run("exit 127").status, 127);
}

TEST_F(JobTest, KillsAProgramThatIsOverdue) {
    int asked = 0;
    const JobEnd end = run_job({.arguments = {"sleep", "60"},
                                .error_log = scratch.path() / "stderr",
                                .request_stop = [](int) { return true; },
                                .overdue = [&] { return ++asked == 2; }});
    EXPECT_EQ(asked, 2);
    EXPECT_EQ(end.signal, 0);
    // By SIGTERM, or by SIGKILL where another test has left SIGTERM blocked for the child.
    EXPECT_TRUE(end.status == 128 + SIGTERM || end.status == 128 + SIGKILL) << end.status;
}

// As mpirun may do after MPI_Abort.
TEST_F(JobTest, KillsAProgramThatStaysWithoutItsChildren) {
    bool had_children = true;
    const auto play = [&](const std::string& script) {
        return run_job({.arguments = {"sh", "-c", script},
                        .error_log = scratch.path() / "stderr",
                        .request_stop = [](int) { return true; },
                        .had_children = [&] { return had_children; }});
    };
    // The last of them may be gone before anybody has looked.
    const JobEnd stayed = play("exec sleep 600");
    EXPECT_TRUE(stayed.status == 128 + SIGTERM || stayed.status == 128 + SIGKILL) << stayed.status;
    EXPECT_EQ(stayed.signal, 0);
    EXPECT_FALSE(stayed.crashed);
    EXPECT_EQ(play("sleep 2; exit 3").status, 3);
    // Before the first it may take its time.
    had_children = false;
    EXPECT_EQ(play("exec sleep 13").status, 0);
}

// The job takes it, whose programs do not inherit that it was held.
TEST_F(JobTest, AnAnnouncementBeforeTheJobIsARequest) {
    hold_announcements();
    raise(SIGUSR1);
    const std::string stop = (scratch.path() / "STOP").string();
    const JobEnd end = run("until [ -e " + stop + " ]; do sleep 0.05; done; kill -USR1 $$; exit 7");
    EXPECT_EQ(end.signal, SIGUSR1);
    EXPECT_FALSE(end.killed);
    EXPECT_EQ(end.status, 128 + SIGUSR1);
    unblock(SIGUSR1);
}

TEST_F(JobTest, FirstSignalIsARequest) {
    const std::string stop = (scratch.path() / "STOP").string();
    const Later signal(1, SIGTERM);
    const JobEnd end = run("until [ -e " + stop + " ]; do sleep 0.05; done; exit 7");
    EXPECT_EQ(end.signal, SIGTERM);
    EXPECT_FALSE(end.killed);
    EXPECT_EQ(end.status, 7);
    EXPECT_EQ(requests, 1);
}

// As under nohup, when the terminal is closed.
TEST_F(JobTest, AnIgnoredHangupStaysIgnored) {
    const auto before = signal(SIGHUP, SIG_IGN);
    {
        const Later hangup(1, SIGHUP);
        const JobEnd end = run("sleep 1; exit 7");
        EXPECT_EQ(end.signal, 0);
        EXPECT_EQ(end.status, 7);
        EXPECT_EQ(requests, 0);
    }
    unblock(SIGHUP);  // Later has blocked it
    sigset_t pending;
    sigpending(&pending);
    EXPECT_FALSE(sigismember(&pending, SIGHUP));
    signal(SIGHUP, before);
}

TEST_F(JobTest, PipesMayBreakForThisProcessAlone) {
    const PipesMayBreak here;
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    close(ends[0]);
    EXPECT_EQ(write(ends[1], "x", 1), -1);
    close(ends[1]);
    // Signals that the job ignores; SIGPIPE is bit 13.
    run("echo $((0x$(awk '/^SigIgn/ {print $2}' /proc/$$/status) >> 12 & 1)) >&2");
    EXPECT_EQ(text("stderr"), "0\n");
}

// Not by the job, which has not begun, but by whoever waits before it.
TEST_F(JobTest, AnAnnouncementIsTaken) {
    hold_announcements();
    EXPECT_FALSE(announced());
    raise(SIGUSR1);
    EXPECT_TRUE(announced());
    EXPECT_FALSE(announced());
    unblock(SIGUSR1);
}

TEST_F(JobTest, SecondSignalKillsTheWholeSession) {
    // A grandchild in its own process group, as mpirun creates them, that ignores SIGTERM.
    const std::string pid_file = (scratch.path() / "pid").string();
    const Later signals(2, SIGINT);
    const JobEnd end = run("set -m; (trap '' TERM; sh -c 'echo $PPID' > " + pid_file +
                           "; while :; do sleep 1; done) & wait");
    EXPECT_TRUE(end.killed);
    EXPECT_EQ(requests, 1);
    const pid_t grandchild = std::stoi(text("pid"));
    ASSERT_GT(grandchild, 1);
    for (int i = 0; i < 50 && kill(grandchild, 0) == 0; ++i) {
        std::ifstream stat("/proc/" + std::to_string(grandchild) + "/stat");
        std::string line;
        std::getline(stat, line);
        if (line.find(") Z ") != std::string::npos) break;  // dead, not yet collected by init
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        ASSERT_LT(i, 49) << "the grandchild is alive: " << line;
    }
}

}  // namespace
}  // namespace turbidite
