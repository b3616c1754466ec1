// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A small run that is meant to fail: six discs in a 6 x 6 D box, 24 x 24 cells, some milliseconds
// per window, and a row of history.csv for every window.
#pragma once

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>
#include <vector>

#include "coupler/protocol/failure.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {

class FailingRun : public ShellTest {
 protected:
    FailingRun() { with_reports(); }

    static constexpr auto small_case =
        "domain: {size: [6, 6]}\n"
        "grains: {adapter: standalone-nscd, count: 6}\n"
        "fluid: {reynolds: 30, cells_per_diameter: 4}\n"
        "time: {step: 0.05, end: 500}\n"
        "output: {interval: 0.05}\n"
        "limits: {stall_soft: 1, stall_hard: 3}\n";

    void SetUp() override { scratch.write("small.yaml", small_case); }

    std::string run_line(const std::string& options = "",
                         const std::string& program = TURBIDITE_PROGRAM) const {
        return "timeout 60 " + program + " run small.yaml" + into_run_folder() + " " + options;
    }

    /// Starts the run and returns its process when it has written `rows` rows of history.
    pid_t start(long rows, const std::string& options = "",
                const std::string& program = TURBIDITE_PROGRAM) const {
        const pid_t child = fork();
        if (child == 0) {
            const std::string line = "cd " + scratch.path().string() + " && exec " + program +
                                     " run small.yaml" + into_run_folder() + " " + options +
                                     " >out 2>err </dev/null";
            execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
            _exit(127);
        }
        for (int i = 0; i < 300 && rows_of_history() < rows; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        EXPECT_GE(rows_of_history(), rows) << "the run did not get going";
        return child;
    }

    Answer end_of(pid_t child) const {
        int status = 0;
        waitpid(child, &status, 0);
        return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
                text(scratch.path() / "out"), text(scratch.path() / "err")};
    }

    /// Processes with the run folder and `what` on their command line.
    std::vector<pid_t> processes(const std::string& what) const {
        std::vector<pid_t> found;
        for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
            const std::string name = entry.path().filename();
            if (name.find_first_not_of("0123456789") != std::string::npos) continue;
            const std::string line = text(entry.path() / "cmdline");
            const bool ours = line.find(run_folder().string()) != std::string::npos;
            if (ours && line.find(what) < line.find('\0')) found.push_back(std::stoi(name));
        }
        return found;
    }

    void expect_nothing_left() const {
        for (int i = 0; i < 30 && !processes("").empty(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        EXPECT_TRUE(processes("").empty());
    }

    void expect_good_output_is_kept(ExitCode code) const {
        EXPECT_EQ(record().at("exit_code"), static_cast<int>(code));
        EXPECT_GE(rows_of_history(), 2);
        for (const char* file : {"grains/grains.pvd", "grains/grains_00000001.vtp", "report.html"})
            EXPECT_TRUE(std::filesystem::exists(run_folder() / file)) << file;
    }
};

}  // namespace turbidite
