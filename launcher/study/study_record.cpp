// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/study/study_record.hpp"

#include <fmt/format.h>

#include <optional>

#include "coupler/checkpoint/checkpoint_sets.hpp"
#include "coupler/protocol/failure.hpp"
#include "launcher/case/files/run_folder.hpp"
#include "launcher/job/folder/run_json.hpp"
#include "launcher/study/other_defaults.hpp"

namespace turbidite {
namespace {

using Record = nlohmann::ordered_json;

std::filesystem::path record_in(const std::filesystem::path& out) {
    return out / "study.json";
}

std::string error_of(const PlannedRun& run, RunState state, const Record& record,
                     const WhyNot& why_not) {
    if (state == RunState::failed) return record.value("error", "");
    const auto reason = why_not.find(run.path());
    return state == RunState::missing && reason != why_not.end() ? reason->second : "";
}

nlohmann::ordered_json run_entry(const PlannedRun& run, const std::filesystem::path& out,
                                 const WhyNot& why_not) {
    const RunFolder folder{out / run.path()};
    const Record record = read_run_json(folder.record());
    const RunState state = state_of(run, out);
    nlohmann::ordered_json values = nlohmann::ordered_json::object();
    for (const auto& [key, value] : run.values) values[key] = value;
    return {{"part", run.part},
            {"name", run.name},
            {"folder", run.path()},
            {"values", values},
            {"status", state == RunState::missing ? "missing" : record.value("status", "unknown")},
            {"error", error_of(run, state, record, why_not)}};
}

/// Of runs that study.json calls missing.
WhyNot reasons_in(const std::filesystem::path& study_json) {
    WhyNot reasons;
    const Record record = read_run_json(study_json);
    for (const auto& run : record.value("runs", Record::array()))
        if (run.value("status", "") == "missing" && !run.value("error", "").empty())
            reasons[run.value("folder", "")] = run.value("error", "");
    return reasons;
}

/// The exit code, if it has ended by a word of its own.
std::optional<ExitCode> end_of(const Record& record) {
    const auto code = record.find("exit_code");
    if (code == record.end() || !code->is_number_integer()) return std::nullopt;
    return static_cast<ExitCode>(code->get<int>());
}

std::int64_t count_in(const Record& record, const char* name) {
    const auto count = record.find(name);
    return count != record.end() && count->is_number_integer() ? count->get<std::int64_t>() : -1;
}

bool is_whole(const Record& record) {
    return record.value("status", "") == "done" &&
           count_in(record, "windows_done") == count_in(record, "windows");
}

/// Killed, stopped on request, or said to be done before its last window.
bool was_cut_off(const Record& record) {
    const std::optional<ExitCode> end = end_of(record);
    return !end || *end == ExitCode::interrupted || *end == ExitCode::terminated ||
           *end == ExitCode::done;
}

/// Of the planned case, or of that with its grains poured.
bool is_of(const PlannedRun& run, const Record& record) {
    return record.value("case_hash", "") == run.hash ||
           record.value("hash_before_pouring", "") == run.hash;
}

bool has_checkpoint(const std::filesystem::path& folder) {
    return !CheckpointSets(folder).names().empty();
}

}  // namespace

RunState state_of(const PlannedRun& run, const std::filesystem::path& out) {
    const std::filesystem::path folder = out / run.path();
    const Record record = read_run_json(RunFolder{folder}.record());
    const bool same = is_of(run, record);
    if (!same && (record.empty() || !other_defaults(run, folder))) return RunState::missing;
    if (is_whole(record)) return same ? RunState::done : RunState::kept;
    if (was_cut_off(record) && has_checkpoint(folder)) return RunState::begun;
    return record.value("status", "") == "prepared" ? RunState::missing : RunState::failed;
}

bool may_go_on(const PlannedRun& run, const std::filesystem::path& out) {
    const RunState state = state_of(run, out);
    if (state == RunState::begun) return true;
    const std::filesystem::path folder = out / run.path();
    const auto end = end_of(read_run_json(RunFolder{folder}.record()));
    const bool by_chance = end == ExitCode::participant_failed || end == ExitCode::stalled;
    return state == RunState::failed && by_chance && has_checkpoint(folder);
}

void require_own_record(const std::filesystem::path& out) {
    const std::filesystem::path file = record_in(out);
    std::error_code none;
    const auto size = std::filesystem::file_size(file, none);
    if (none || size == 0 || read_run_json(file).contains("runs")) return;
    throw Failure(ExitCode::bad_input,
                  fmt::format("turbidite study: {} would be overwritten. It is not of a study.\n  "
                              "Rename it, or name another folder with --out. Exit code 2.",
                              file.string()));
}

void write_study_record(const Study& study, const std::vector<PlannedRun>& plan,
                        const std::filesystem::path& out, const WhyNot& why_not) {
    const std::filesystem::path file = record_in(out);
    WhyNot reasons = why_not;
    reasons.merge(reasons_in(file));
    auto runs = nlohmann::ordered_json::array();
    for (const PlannedRun& run : plan) runs.push_back(run_entry(run, out, reasons));
    write_run_json(file, {{"study", study.name},
                          {"command", study.command},
                          {"figures", study.figures},
                          {"runs", runs}});
}

}  // namespace turbidite
