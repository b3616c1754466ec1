// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A small run that is meant to fail: six discs in a 6 x 6 D box, 24 x 24 cells, some milliseconds
// per window, and a row of history.csv for every window.
#pragma once

#include "coupler/protocol/failure.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {

class FailingRun : public ShellTest {
 protected:
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
        const pid_t child = begin(program + " run small.yaml" + into_run_folder() + " " + options);
        for (int i = 0; i < 3000 && rows_of_history() < rows; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        EXPECT_GE(rows_of_history(), rows) << "the run did not get going";
        return child;
    }

    /// Processes with the run folder and `what` on their command line.
    std::vector<pid_t> processes(const std::string& what) const {
        return ShellTest::processes(run_folder(), what);
    }
    void expect_nothing_left() const { ShellTest::expect_nothing_left(run_folder()); }

    void expect_good_output_is_kept(ExitCode code) const {
        EXPECT_EQ(record().at("exit_code"), static_cast<int>(code));
        EXPECT_GE(rows_of_history(), 2);
        for (const char* file : {"grains/grains.pvd", "grains/grains_00000001.vtp"})
            EXPECT_TRUE(std::filesystem::exists(run_folder() / file)) << file;
    }
    /// After with_reports().
    void expect_report() const {
        EXPECT_TRUE(std::filesystem::exists(run_folder() / "report.html"));
    }
};

}  // namespace turbidite
