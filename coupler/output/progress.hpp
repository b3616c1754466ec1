// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The progress display of a run: one line of at most 60 columns, rewritten in place on a terminal,
// otherwise printed at every output interval. logs/coupler.log has the same windows with contacts,
// multipliers, Courant number and divergence.
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include "coupler/output/history.hpp"

namespace turbidite {

class Progress {
 public:
    /// `terminal`: standard output is a terminal whose lines can be rewritten
    /// (TURBIDITE_PROGRESS=terminal).
    Progress(const std::filesystem::path& log, bool terminal, const RunValues& run);

    /// A line of its own, on screen and in the log.
    void say(const std::string& text);

    /// The same in the log only.
    void log(const std::string& text);

    /// The run goes on after so many windows, which took no time here.
    void begin_at(std::int64_t windows) { windows_before_ = windows; }

    /// Shows the state of the run after a window. `due`: an output interval ended here.
    void show(const Row& row, bool due);

 private:
    using Clock = std::chrono::steady_clock;
    void clear_line();

    std::ofstream log_;
    bool terminal_;
    bool line_open_ = false;
    RunValues run_;
    std::int64_t windows_before_ = 0;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_shown_{};
};

/// "12.5/70 t_c  fall 0.321 u_c  overlap 3e-05 D  2:01:05 left". A window with a solve that
/// stopped at its limit says NOT CONVERGED in place of the mean fall. `per_window` [s] of wall
/// time.
std::string progress_line(const Row& row, const RunValues& run, double per_window);

/// "1:05", "2:01:05".
std::string clock_text(double seconds);

}  // namespace turbidite
