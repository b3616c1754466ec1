// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The output of a run: one row of history.csv and one piece of each series per output, and
// statistics over the windows.
#pragma once

#include <chrono>

#include "coupler/output/contact_series.hpp"
#include "coupler/output/grain_series.hpp"
#include "coupler/output/history.hpp"
#include "coupler/output/output_state.hpp"
#include "coupler/output/probe_series.hpp"

namespace turbidite {

class RunOutput {
 public:
    /// `history`: the file, beside which probes.csv is written; `series`: the folder of
    /// grains.pvd.
    RunOutput(const std::filesystem::path& history, const std::filesystem::path& series,
              const RunValues& run, const ShapeTable& shapes);

    /// The output of a run that goes on: files are cut to the lengths they had.
    RunOutput(const std::filesystem::path& history, const std::filesystem::path& series,
              const RunValues& run, const ShapeTable& shapes, const OutputState& earlier);

    /// What the next windows depend on, and lengths().
    OutputState saved();

    /// Of the files, which are on the disk then.
    OutputLengths lengths();

    /// Writes the state at t = 0.
    void begin(Motion state);

    /// The first window of this part of the run begins now.
    void begin_windows() { lap(); }

    /// Records a window that passed the checks; `waited` [s] is the time spent waiting for
    /// participants.
    void record(const Window& window, WindowResult result, double waited);

    /// Of a window that did not pass them.
    void record_refused(const WindowResult& result) { statistics_.raise_maxima(result); }

    /// Writes the last window: its row, grains and contacts.
    void write();

    /// The state where the last window ended.
    const Motion& state() const { return last_.state; }

    /// Report on the last window; before the first, on the start.
    Row row() const;

    const RunStatistics& statistics() const { return statistics_; }

 private:
    using Clock = std::chrono::steady_clock;

    double lap();

    bool wet_;
    History history_;
    GrainSeries grains_;
    ContactSeries contacts_;
    ProbeSeries probes_;
    RunStatistics statistics_;
    WorkOnGrains work_;
    SinceRow since_row_;
    Window window_;
    WindowResult last_;
    Clock::time_point lap_ = Clock::now();
};

}  // namespace turbidite
