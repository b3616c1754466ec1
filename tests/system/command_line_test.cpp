// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The program as a user meets it: exit codes, what is printed where, what a run leaves behind.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

const std::string program = TURBIDITE_PROGRAM;
const std::string quickstart = TURBIDITE_SOURCE_DIR "/configs/quickstart.yaml";
// Dry grains without YADE: the quickest whole job.
const std::string quick = " --set fluid.enabled=false --set grains.adapter=standalone-nscd";

class CommandLine : public ShellTest {
 protected:
    Answer turbidite(const std::string& arguments) const {
        return shell(program + " " + arguments);
    }
};

TEST_F(CommandLine, MisspeltKeyStartsNothing) {
    const Answer answer = turbidite("run " + quickstart + into_run_folder() +
                                    " --set contact.fricton=0.3 --set time.step=-1");
    EXPECT_EQ(answer.code, 2);
    EXPECT_SAYS(answer.err, "contact.friction?");
    EXPECT_SAYS(answer.err, "time.step = -1");
    EXPECT_SAYS(answer.err, "2 errors, nothing was started. Exit code 2.");
    EXPECT_FALSE(fs::exists(run_folder()));
}

TEST_F(CommandLine, BadUsage) {
    EXPECT_EQ(turbidite("").code, 2);
    EXPECT_EQ(turbidite("run").code, 2);
    EXPECT_EQ(turbidite("run nowhere.yaml").code, 2);
    EXPECT_EQ(turbidite("run " + quickstart + " --frobnicate").code, 2);
    EXPECT_EQ(turbidite("report " + scratch.path().string()).code, 2);
    EXPECT_SAYS(turbidite("chekc x").err, "Did you mean check?");
}

TEST_F(CommandLine, HelpAndVersion) {
    const Answer help = turbidite("--help");
    EXPECT_EQ(help.code, 0);
    for (const char* command : {"run", "check", "report", "keys", "test", "bench"})
        EXPECT_SAYS(help.out, std::string("\n  ") + command);
    EXPECT_SAYS(turbidite("--version").out, "turbidite ");
    EXPECT_SAYS(turbidite("keys").out, "| `contact.friction` |");
}

TEST_F(CommandLine, CheckWritesNothing) {
    const Answer answer = turbidite("check " + quickstart);
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_SAYS(answer.out, "60 grains");
    EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path()), fs::directory_iterator()), 2);
}

TEST_F(CommandLine, DryRunPrintsOneLineThatRunsTheJob) {
    const Answer answer = turbidite("run " + quickstart + quick + " --set time.end=0.2 --dry-run" +
                                    into_run_folder());
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_EQ(answer.out.rfind("mpirun ", 0), 0u) << answer.out;
    EXPECT_EQ(std::count(answer.out.begin(), answer.out.end(), '\n'), 1);
    EXPECT_TRUE(record().at("exit_code").is_null());

    const Answer pasted = shell(answer.out.substr(0, answer.out.size() - 1));
    EXPECT_EQ(pasted.code, 0) << pasted.err;
    EXPECT_EQ(record().at("windows_done"), 16);  // 0.2 / 0.0125
}

TEST_F(CommandLine, DryRunOfTheQuickstartPreparesItsFluid) {
    const Answer answer = turbidite("run " + quickstart + " --dry-run" + into_run_folder());
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_SAYS(answer.out, "turbidite-fluid -case " + (run_folder() / "fluid").string());
    EXPECT_SAYS(answer.out, "yade -n -x");
    EXPECT_TRUE(fs::exists(run_folder() / "fluid/constant/polyMesh/points"));
}

TEST_F(CommandLine, RunLeavesAWholeFolder) {
    const Answer answer =
        turbidite("run " + quickstart + quick + " --set time.end=1 --set output.interval=0.25" +
                  into_run_folder());
    ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_EQ(record().at("status"), "done");
    EXPECT_EQ(record().at("exit_code"), 0);
    EXPECT_EQ(rows_of_history(), 5);  // t = 0, 0.25, 0.5, 0.75, 1
    for (const char* file : {"case.yaml", "grains/initial.csv", "grains/grains.pvd",
                             "logs/coupler.log", "logs/grains.log", "report.html"})
        EXPECT_TRUE(fs::exists(run_folder() / file)) << file;
    EXPECT_SAYS(text(run_folder() / "report.html"), "Status: done");
}

TEST_F(CommandLine, WetRunWithYade) {
    const Answer answer =
        turbidite("run " + quickstart + " --set time.end=0.1" + into_run_folder());
    ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_EQ(record().at("ranks").size(), 2u);
    EXPECT_TRUE(fs::exists(run_folder() / "logs/fluid.log"));
    EXPECT_EQ(turbidite("report " + run_folder().string()).code, 0);
}

TEST_F(CommandLine, OccupiedFolderIsRefused) {
    scratch.write("run/precious", "x");
    const Answer answer = turbidite("run " + quickstart + quick + into_run_folder());
    EXPECT_EQ(answer.code, 2);
    EXPECT_SAYS(answer.err, "already holds something");
}

TEST_F(CommandLine, FirstInterruptEndsTheRunAfterItsWindow) {
    // 160,000 windows never end by themselves within the test.
    const pid_t child = fork();
    if (child == 0) {
        const std::string line = "exec " + program + " run " + quickstart + quick +
                                 " --set time.end=2000 --set output.interval=1" +
                                 into_run_folder() + " >" + (scratch.path() / "out").string() +
                                 " 2>&1";
        execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
        _exit(127);
    }
    for (int i = 0; i < 600 && rows_of_history() < 2; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 130) << text(scratch.path() / "out");
    EXPECT_EQ(record().at("exit_code"), 130);
    EXPECT_GT(record().at("windows_done").get<int>(), 0);
    EXPECT_TRUE(fs::exists(run_folder() / "report.html"));
}

}  // namespace
}  // namespace turbidite
