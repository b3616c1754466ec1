// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Common to tests of whole commands: a scratch folder, a shell in it, and access to the files of a
// run.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
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

    std::filesystem::path run_folder() const { return scratch.path() / "run"; }
    std::string into_run_folder() const { return " --out " + run_folder().string(); }

    /// Lines of history.csv of a run in the scratch folder, without the wall times.
    std::vector<std::string> lines_of_history(const std::string& run) const {
        std::istringstream lines(text(scratch.path() / run / "history.csv"));
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
