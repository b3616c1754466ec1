// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/run_output.hpp"

#include <algorithm>
#include <utility>

#include "coupler/protocol/files/stored_file.hpp"

namespace turbidite {

RunOutput::RunOutput(const std::filesystem::path& history, const std::filesystem::path& series,
                     const RunValues& run, const ShapeTable& shapes)
    : wet_(run.wet),
      history_(history, run, shapes),
      grains_(series, shapes),
      contacts_(series, run.dimension),
      probes_(history.parent_path() / ProbeSeries::file_name, run),
      statistics_(run) {}

namespace {

/// Of all files before the first is cut: one that was changed is found with the others as they
/// were.
const OutputLengths& required(const std::filesystem::path& history,
                              const std::filesystem::path& series, const OutputLengths& lengths) {
    require_length(history, lengths.history);
    require_length(series / GrainSeries::collection_name, lengths.grains);
    if (lengths.contacts >= 0)
        require_length(series / ContactSeries::collection_name, lengths.contacts);
    if (lengths.probes >= 0)
        require_length(history.parent_path() / ProbeSeries::file_name, lengths.probes);
    return lengths;
}

}  // namespace

RunOutput::RunOutput(const std::filesystem::path& history, const std::filesystem::path& series,
                     const RunValues& run, const ShapeTable& shapes, const OutputState& earlier)
    : wet_(run.wet),
      history_(history, run, shapes, required(history, series, earlier.lengths).history),
      grains_(series, shapes, earlier.lengths.grains),
      contacts_(series, run.dimension),
      probes_(history.parent_path() / ProbeSeries::file_name, run),
      statistics_(run),
      since_row_(earlier.since_row) {
    std::error_code none;  // files that began later begin again
    if (earlier.lengths.contacts >= 0)
        contacts_.resume(earlier.lengths.contacts);
    else
        std::filesystem::remove(series / ContactSeries::collection_name, none);
    if (earlier.lengths.probes >= 0)
        probes_.resume(earlier.lengths.probes);
    else
        std::filesystem::remove(probes_.file(), none);
    statistics_.resume(earlier.statistics);
    last_.state = earlier.state;
}

OutputState RunOutput::saved() {
    const OutputLengths now = lengths();
    return {last_.state, statistics_, since_row_, now, now};
}

OutputLengths RunOutput::lengths() {
    OutputLengths lengths;
    lengths.history = history_.length();
    // The checkpoint will say how long these files are: so much of them, and all that they name,
    // must be there after a power cut.
    put_on_disk(history_.file());
    lengths.grains = grains_.collection().length();
    grains_.collection().put_on_disk();
    if (vtk::Collection* contacts = contacts_.collection()) {
        lengths.contacts = contacts->length();
        contacts->put_on_disk();
    }
    lengths.probes = probes_.length();
    if (lengths.probes >= 0) put_on_disk(probes_.file());
    return lengths;
}

void RunOutput::begin(Motion state) {
    last_.state = std::move(state);
    history_.append(row());
    grains_.write(0.0, 0, 1.0, last_.state, {});
}

/// Seconds since the end of the previous window, so that the windows add up to the run.
double RunOutput::lap() {
    const Clock::time_point before = std::exchange(lap_, Clock::now());
    return std::chrono::duration<double>(lap_ - before).count();
}

void RunOutput::record(const Window& window, WindowResult result, double waited) {
    window_ = window;
    const GrainWork work = work_(last_.state, result, window.step);
    last_ = std::move(result);
    statistics_.take_in(last_);
    WallTimes spent;
    spent.step = lap();
    spent.fluid = last_.kicks.report.wall_seconds;
    // Two calls of the adapter: advance and apply_kick.
    spent.grains = last_.motion.report.wall_seconds + last_.state.report.wall_seconds;
    // What the coupler did itself; two clocks may differ by their rounding.
    spent.coupling = std::max(0.0, spent.step - waited);
    since_row_.take_in(spent, last_.motion.report.converged, work);
}

Row RunOutput::row() const {
    Row row;
    row.state = &last_.state;
    row.step = statistics_.windows_done;
    if (row.step == 0) return row;
    row.time = static_cast<double>(row.step) * window_.step;
    row.contact = &last_.motion.report;
    row.fluid = wet_ ? &last_.kicks.report : nullptr;
    for (const Kick& kick : last_.kicks.kicks)
        for (std::size_t i = 0; i < 3; ++i) row.fluid_force[i] += kick.force[i];
    row.joint = last_.joint ? &*last_.joint : nullptr;
    if (last_.grain_balance) row.grain_balance = last_.grain_balance->defect;
    if (last_.motion_defect) row.motion_defect = last_.motion_defect->defect;
    row.since = since_row_;
    return row;
}

void RunOutput::write() {
    const Row now = row();
    grains_.write(now.time, now.step, window_.step, last_.state, last_.kicks.kicks);
    contacts_.write(now.time, now.step, window_.step, last_.state);
    history_.append(now);
    probes_.append(now.time, last_.kicks.report.probes);
    since_row_ = {};
}

}  // namespace turbidite
