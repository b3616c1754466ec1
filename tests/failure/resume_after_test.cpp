// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Whatever ended a run, `turbidite resume` goes on, and the history in the end is that of a run
// that nothing ended: everything killed at random moments, one program killed, a full disk, signals
// of a batch system.
//
// TURBIDITE_KILLS=100 in the environment kills so many times instead of a few (4 minutes):
//
//     TURBIDITE_KILLS=100 build/release/bin/failure_tests --gtest_filter=*KilledAtRandomMoments*
#include <random>

#include "tests/failure/failing_run.hpp"
#include "tests/failure/small_disk.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;
using Milliseconds = std::chrono::milliseconds;

class ResumeAfter : public FailingRun {
 protected:
    void SetUp() override {
        ::setenv("TURBIDITE_REPORT", "off", 1);  // no test here looks at it
        scratch.write("small.yaml",
                      "domain: {size: [6, 6]}\n"
                      "grains: {adapter: standalone-nscd, count: 6}\n"
                      "fluid: {reynolds: 30, cells_per_diameter: 4}\n"
                      "time: {step: 0.02, end: 12}\n"
                      "output: {interval: 0.1}\n"
                      "checkpoint: {windows: 40}\n");
        const Answer whole = shell("timeout 60 " TURBIDITE_PROGRAM " run small.yaml --out whole");
        ASSERT_EQ(whole.code, 0) << whole.err;
        whole_ = lines_of_history("whole");
        ASSERT_EQ(whole_.size(), 122u);
    }

    Answer resume(const std::string& options = "") const {
        return shell("timeout 60 " TURBIDITE_PROGRAM " resume run" + options);
    }

    void expect_resumed_to_the_end() const {
        const Answer answer = resume();
        EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
        EXPECT_SAYS(answer.out, " goes on after window ");
        EXPECT_EQ(lines_of_history("run"), whole_);
    }

    /// Whether it has ended by itself within this time; if not, everything is killed.
    bool ended_within(pid_t run, Milliseconds time) const {
        const auto deadline = std::chrono::steady_clock::now() + time;
        int status = 0;
        while (std::chrono::steady_clock::now() < deadline) {
            if (waitpid(run, &status, WNOHANG) == run) {
                EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0)
                    << text(scratch.path() / "out") << text(scratch.path() / "err");
                return true;
            }
            std::this_thread::sleep_for(Milliseconds(5));
        }
        kill_all(run, run_folder());
        return false;
    }

    /// Whether a command found a set to go on from, and did not begin afresh.
    static bool went_on(const std::string& output) {
        return output.find(" goes on after window ") != std::string::npos;
    }

    bool begun() const { return fs::exists(run_folder() / "case.yaml"); }

    static int kills() {
        const char* given = std::getenv("TURBIDITE_KILLS");
        return given ? std::atoi(given) : 6;
    }

    std::vector<std::string> whole_;
};

TEST_F(ResumeAfter, EverythingIsKilledAtRandomMoments) {
    std::mt19937 random(2011);
    std::uniform_int_distribution<int> moment(20, 2500);  // [ms]
    int resumptions = 0, completed = 0;  // resumptions: runs that went on from a set
    for (int left = kills(); left > 0 && !HasFailure();) {
        const bool again = begun();
        const pid_t run = begin(std::string(TURBIDITE_PROGRAM) +
                                (again ? " resume run" : " run small.yaml --force --out run"));
        const bool ended = ended_within(run, Milliseconds(moment(random)));
        resumptions += went_on(text(scratch.path() / "out")) ? 1 : 0;
        if (!ended) {
            --left;
            continue;
        }
        EXPECT_EQ(lines_of_history("run"), whole_);
        ++completed;
        fs::remove_all(run_folder());
    }
    if (begun()) {
        const Answer answer = resume();
        EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
        EXPECT_EQ(lines_of_history("run"), whole_);
        resumptions += went_on(answer.out) ? 1 : 0;
    }
    EXPECT_GT(resumptions, 0);
    std::printf("%d kills, %d resumptions, %d runs completed in between\n", kills(), resumptions,
                completed);
}

TEST_F(ResumeAfter, AProgramIsKilled) {
    for (const char* program : {"turbidite-fluid", "turbidite-coupler"}) {
        fs::remove_all(run_folder());
        const pid_t run = start(60);
        for (const pid_t process : processes(program)) kill(process, SIGKILL);
        const Answer answer = end_of(run);
        EXPECT_EQ(answer.code, 4) << program << answer.err;
        EXPECT_SAYS(answer.err, "turbidite resume " + run_folder().string());
        expect_resumed_to_the_end();
    }
}

// What windows were played with stays, also if the coupler is ended before it can count them.
TEST_F(ResumeAfter, WindowsThatWerePlayedKeepTheirValues) {
    ASSERT_EQ(shell(run_line("--set time.end=1")).code, 0);
    const pid_t on =
        begin(TURBIDITE_PROGRAM " resume run --set time.end=12 --set contact.tolerance=1e-5");
    const fs::path later = run_folder() / "checkpoints/w00000080";
    for (int i = 0; i < 3000 && !fs::exists(later); ++i)
        std::this_thread::sleep_for(Milliseconds(10));
    for (const char* program : {"turbidite-coupler", "turbidite-fluid"})
        for (const pid_t process : processes(program)) kill(process, SIGKILL);
    const Answer answer = end_of(on);
    EXPECT_EQ(answer.code, 4) << answer.err;
    EXPECT_FALSE(record()["parts"].back().contains("windows_done"));
    EXPECT_EQ(answer.err.find("No window is left"), std::string::npos) << answer.err;
    EXPECT_SAYS(text(run_folder() / "case.yaml"), "tolerance: 1e-05");
    EXPECT_EQ(resume().code, 0);
    EXPECT_EQ(lines_of_history("run").size(), whole_.size());
}

// The disk becomes full, is made larger, and the run goes on from the last whole set.
TEST_F(ResumeAfter, AFullDisk) {
    if (shell(on_small_disk("true")).code != 0) GTEST_SKIP() << no_small_disk;
    const Answer answer = shell(on_small_disk(
        "timeout 100 " TURBIDITE_PROGRAM
        " run small.yaml --out disk/run --set checkpoint.windows=10; echo code $?; "
        "mount -o remount,size=100m disk; timeout 60 " TURBIDITE_PROGRAM
        " resume disk/run; echo then code $?; mkdir -p run; cp disk/run/history.csv run"));
    EXPECT_SAYS(answer.err, "is the disk full?");
    EXPECT_SAYS(answer.out, "\ncode 4\n");
    EXPECT_SAYS(answer.out, " goes on after window ");
    EXPECT_EQ(answer.out.find(" goes on after window 0 "), std::string::npos) << answer.out;
    EXPECT_SAYS(answer.out, "\nthen code 0\n");
    EXPECT_EQ(lines_of_history("run"), whole_) << answer.err;
}

TEST_F(ResumeAfter, SignalsOfABatchSystem) {
    for (const int signal : {SIGUSR1, SIGINT}) {
        fs::remove_all(run_folder());
        const pid_t run = start(30);
        kill(run, signal);
        const Answer answer = end_of(run);
        EXPECT_EQ(answer.code, signal == SIGINT ? 130 : 143) << answer.err;
        EXPECT_SAYS(answer.err, "its output and a checkpoint are written");
        expect_resumed_to_the_end();
    }
}

// A batch script has the line of --dry-run, and the batch system signals mpirun.
TEST_F(ResumeAfter, SigUsr1ThroughMpirun) {
    const Answer line = shell(run_line("--dry-run"));
    ASSERT_EQ(line.code, 0) << line.err;
    const pid_t job = begin(line.out.substr(0, line.out.size() - 1));
    for (int i = 0; i < 300 && rows_of_history() < 30; ++i)
        std::this_thread::sleep_for(Milliseconds(20));
    kill(job, SIGUSR1);
    const Answer answer = end_of(job);
    EXPECT_EQ(answer.code, 143) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, "its output and a checkpoint are written");
    EXPECT_EQ(record().at("exit_code"), 143);
    expect_nothing_left();
    expect_resumed_to_the_end();
}

TEST_F(ResumeAfter, AFileStops) {
    const pid_t run = start(30);
    shell("touch run/CHECKPOINT");
    while (fs::exists(run_folder() / "CHECKPOINT")) std::this_thread::sleep_for(Milliseconds(5));
    shell("touch run/WRITE");
    while (fs::exists(run_folder() / "WRITE")) std::this_thread::sleep_for(Milliseconds(5));
    shell("touch run/STOP");
    const Answer answer = end_of(run);
    EXPECT_EQ(answer.code, 130) << answer.err;
    EXPECT_FALSE(fs::exists(run_folder() / "STOP"));
    const Answer resumed = resume();
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_GE(lines_of_history("run").size(), whole_.size());  // and the row asked for by WRITE
    EXPECT_EQ(lines_of_history("run").back(), whole_.back());
}

}  // namespace
}  // namespace turbidite
