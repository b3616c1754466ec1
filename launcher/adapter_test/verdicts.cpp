// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/adapter_test/verdicts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "launcher/adapter_test/altered_recording.hpp"
#include "launcher/adapter_test/trial_recording.hpp"

namespace turbidite {
namespace {

constexpr std::int64_t altered_window = 3;

const std::vector<const char*> all_motion = {"mean_velocity_x", "mean_velocity_y",
                                             "mean_position_x", "mean_position_y",
                                             "mean_speed",      "kinetic_energy"};

/// Without the line break and what follows it.
std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

/// The first of these columns in which two trials differ; empty if there is none.
std::string different_column(const Trial& a, const Trial& b) {
    for (const char* column : all_motion)
        if (worst(a, b, {column}) != 0.0) return column;
    return "";
}

}  // namespace

Finding failure_of(const JobOutcome& outcome) {
    const std::string tail = outcome.log_tail.empty() ? "" : "\n" + outcome.log_tail;
    return {Grade::failed, fmt::format("ended with code {}: {}{}", static_cast<int>(outcome.code),
                                       outcome.error, tail)};
}

// An exception is a refusal. What the Python module tells of sys.exit is none: nobody has said why.
std::optional<std::string> refusal_of(const Trial& trial) {
    // A history begins when all have started: what fails later is no refusal.
    if (trial.outcome.code != ExitCode::participant_failed || !trial.history.empty())
        return std::nullopt;
    const auto words = failure_told(trial.recording);
    if (!words || words->empty() || words->rfind("SystemExit", 0) == 0) return std::nullopt;
    return trial.outcome.error;
}

Finding within(double error, double limit, const std::string& what) {
    return {error <= limit ? Grade::met : Grade::failed,
            fmt::format("{} differs by {:.1e}, allowed {:.0e}", what, error, limit)};
}

double worst(const std::vector<double>& column, const std::vector<double>& expected) {
    // A run that ended early has fewer rows.
    if (column.size() != expected.size()) return INFINITY;
    double error = 0.0;
    for (std::size_t i = 0; i < column.size(); ++i)
        error =
            std::max(error, std::isnan(column[i]) ? INFINITY : std::abs(column[i] - expected[i]));
    return error;
}

double worst(const Trial& a, const Trial& b, const std::vector<const char*>& columns) {
    double error = 0.0;
    for (const char* column : columns)
        error = std::max(error, worst(a.history.at(column), b.history.at(column)));
    return error;
}

Finding ends_on_request(const Candidate& candidate, TrialCase trial,
                        const std::filesystem::path& folder) {
    trial.name = "stop";
    trial.overrides.push_back("time.end=100");
    trial.stop_at_once = true;
    const Trial stopped = play_trial(candidate, trial, folder);
    if (stopped.outcome.code != ExitCode::terminated) return failure_of(stopped.outcome);
    return {Grade::met, "left in order after one window"};
}

OnTwoRanks moves_alike(const Candidate& candidate, TrialCase trial,
                       const std::vector<std::string>& keys_of_two, double tolerance,
                       const std::filesystem::path& folder) {
    TrialCase two = trial;
    trial.name += "1-rank", two.name += "2-ranks";
    two.overrides.insert(two.overrides.end(), keys_of_two.begin(), keys_of_two.end());
    // First, since most programs refuse it.
    const Trial shared = play_trial(candidate, two, folder);
    if (const auto words = refusal_of(shared))
        return {{Grade::not_supported, "refuses two ranks: " + *words}, shared};
    const Trial alone = play_trial(candidate, trial, folder);
    if (!alone.done()) return {failure_of(alone.outcome), alone};
    if (!shared.done()) return {failure_of(shared.outcome), shared};
    const double error = worst(
        alone, shared,
        {"mean_velocity_x", "mean_velocity_y", "mean_position_x", "mean_position_y", "mean_speed"});
    return {within(error, tolerance, "the motion on two ranks"), shared};
}

Finding runs_alike(const Candidate& candidate, TrialCase trial,
                   const std::filesystem::path& folder) {
    std::vector<Trial> trials;
    for (const char* turn : {"", "-again"}) {
        trial.name += turn;
        trials.push_back(play_trial(candidate, trial, folder));
        if (!trials.back().done()) return failure_of(trials.back().outcome);
    }
    const std::string column = different_column(trials[0], trials[1]);
    if (!column.empty())
        return {Grade::failed, fmt::format("{} differs between two equal runs", column)};
    return {Grade::met, "two equal runs are equal to the last digit"};
}

Finding goes_on_alike(const Candidate& candidate, TrialCase trial,
                      const std::filesystem::path& folder) {
    TrialCase parts = trial;
    parts.name += "-parts";
    trial.overrides.push_back("time.end=1"), parts.overrides.push_back("time.end=0.45");
    const Trial whole = play_trial(candidate, trial, folder);
    if (!whole.done()) return failure_of(whole.outcome);
    const Trial first = play_trial(candidate, parts, folder);
    if (!first.done()) return failure_of(first.outcome);
    if (!capabilities_of(first.recording).saves_state)
        return {Grade::not_supported, "save and restore are not claimed"};
    if (const std::string fault = save_fault(first.recording); !fault.empty())
        return {Grade::failed, "saves_state is claimed and not kept: " + fault};
    const std::optional<Trial> second = resume_trial(candidate, parts, {"time.end=1"}, folder);
    if (!second) return {Grade::failed, "saves_state is claimed, and there is no checkpoint"};
    if (!second->done()) return failure_of(second->outcome);
    const std::string column = different_column(whole, *second);
    if (!column.empty())
        return {Grade::failed, fmt::format("{} differs from that of a run in one part", column)};
    return {Grade::met, "a run in two parts is equal to one in one part, to the last digit"};
}

Finding refuses_disorder(const Candidate& candidate, const TrialCase& trial, Kind kind,
                         const std::filesystem::path& folder) {
    const Trial recorded = play_trial(candidate, trial, folder);
    if (!recorded.done()) return failure_of(recorded.outcome);
    std::string said;
    for (const Alteration alteration : {Alteration::left_out, Alteration::repeated}) {
        const bool out = alteration == Alteration::left_out;
        const std::string name = out ? "left-out" : "repeated";
        const auto altered = folder / trial.name / (name + ".frames");
        alter_recording(recorded.recording, altered, kind, altered_window, alteration);
        const JobOutcome outcome = replay_trial(candidate, trial, name, altered, folder);
        // What the program itself says begins with this (coupler/replay).
        if (outcome.error.find("ended the run: ") == std::string::npos)
            return {Grade::failed,
                    fmt::format("\"{}\" was {} and the program did not mind: {}", kind_name(kind),
                                out ? "left out" : "repeated",
                                outcome.error.empty() ? "it went on" : first_line(outcome.error))};
        if (said.empty()) said = first_line(outcome.error);
    }
    return {Grade::met, said};
}

}  // namespace turbidite
