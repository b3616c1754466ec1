// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Common to tests of whole commands: a scratch folder, a shell in it, and access to the files of a
// run.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

struct Answer {
    int code = -1;
    std::string out, err;
};

class ShellTest : public ::testing::Test {
 protected:
    /// Runs write no report, which takes longer than most of them, unless a test asks for it.
    ShellTest() { ::setenv("TURBIDITE_REPORT", "off", 1); }
    /// For adapters in Python: the modules of tests/python.
    static void with_python_of_tests() {
        ::setenv("PYTHONPATH", TURBIDITE_SOURCE_DIR "/tests/python", 1);
    }
    static void with_reports() { ::unsetenv("TURBIDITE_REPORT"); }

    ScratchFolder scratch;

    std::string text(const std::filesystem::path& file) const {
        std::ifstream input(file);
        return {std::istreambuf_iterator<char>(input), {}};
    }

    Answer shell(const std::string& line) const {
        const std::string out = scratch.path() / "out", err = scratch.path() / "err";
        const int status = std::system(("cd " + scratch.path().string() + " && { " + line +
                                        "; } >" + out + " 2>" + err + " </dev/null")
                                           .c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text(out), text(err)};
    }

    /// Starts a program with its arguments, in the scratch folder, and does not wait for it.
    pid_t begin(const std::string& line) const {
        const pid_t child = fork();
        if (child != 0) return child;
        const std::string words =
            "cd " + scratch.path().string() + " && exec " + line + " >out 2>err </dev/null";
        execl("/bin/sh", "sh", "-c", words.c_str(), nullptr);
        _exit(127);
    }

    Answer end_of(pid_t child) const {
        int status = 0;
        waitpid(child, &status, 0);
        return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
                text(scratch.path() / "out"), text(scratch.path() / "err")};
    }

    /// Of a process, as its folder of /proc tells it; empty if it ends meanwhile.
    std::string command_line(const std::filesystem::path& process) const {
        try {
            return text(process / "cmdline");
        } catch (const std::ios_base::failure&) {
            return {};
        }
    }

    /// Processes with `folder` and `what` on their command line.
    std::vector<pid_t> processes(const std::filesystem::path& folder,
                                 const std::string& what = "") const {
        std::vector<pid_t> found;
        for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
            const std::string name = entry.path().filename();
            if (name.find_first_not_of("0123456789") != std::string::npos) continue;
            const std::string line = command_line(entry.path());
            const bool ours = line.find(folder.string()) != std::string::npos;
            if (ours && line.find(what) < line.find('\0')) found.push_back(std::stoi(name));
        }
        return found;
    }

    /// `run` first, which would notice the end of the others.
    Answer kill_all(pid_t run, const std::filesystem::path& folder) const {
        kill(run, SIGKILL);
        for (const pid_t process : processes(folder)) kill(process, SIGKILL);
        const Answer answer = end_of(run);
        expect_nothing_left(folder);
        return answer;
    }

    void expect_nothing_left(const std::filesystem::path& folder) const {
        for (int i = 0; i < 30 && !processes(folder).empty(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        EXPECT_TRUE(processes(folder).empty());
    }

    std::filesystem::path run_folder() const { return scratch.path() / "run"; }
    std::string into_run_folder() const { return " --out " + run_folder().string(); }

    /// Lines of a CSV table, without the columns of wall times.
    static std::vector<std::string> lines_without_wall_times(const std::string& table) {
        std::istringstream lines(table);
        std::vector<std::string> result, names;
        for (std::string line; std::getline(lines, line);) {
            std::vector<std::string> cells;
            std::istringstream row(line);
            for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
            if (names.empty()) names = cells;
            std::string kept;
            for (std::size_t i = 0; i < cells.size(); ++i)
                if (names.at(i).rfind("wall_", 0) != 0) kept += cells[i] + ",";
            result.push_back(kept);
        }
        return result;
    }

    /// Those of history.csv of a run in the scratch folder.
    std::vector<std::string> lines_of_history(const std::string& run) const {
        return lines_without_wall_times(text(scratch.path() / run / "history.csv"));
    }

    /// Exit code of a doctor who finds nothing wrong but, maybe, a disk that others have filled.
    int healthy() const { return disk_has_room() ? 0 : 2; }
    bool disk_has_room() const { return std::filesystem::space(scratch.path()).available >= 1e9; }

    nlohmann::json record() const { return nlohmann::json::parse(text(run_folder() / "run.json")); }

    /// x, y, z of every grain's centre at a step given by eight digits, from the `Points` of the
    /// series.
    std::vector<double> centres(const std::string& step) const {
        const std::string file = text(run_folder() / ("grains/grains_" + step + ".vtp"));
        const std::size_t points = file.find('>', file.find("<DataArray", file.find("<Points>")));
        std::istringstream numbers(file.substr(points + 1));
        std::vector<double> result;
        for (double number; numbers >> number;) result.push_back(number);
        return result;
    }

    long rows_of_history() const {
        const std::string history = text(run_folder() / "history.csv");
        return std::count(history.begin(), history.end(), '\n') - 1;
    }
};

}  // namespace turbidite
