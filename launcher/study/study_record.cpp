// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/study/study_record.hpp"

#include "coupler/checkpoint/checkpoint_sets.hpp"
#include "coupler/protocol/failure.hpp"
#include "launcher/case/run_folder.hpp"
#include "launcher/job/run_json.hpp"

namespace turbidite {
namespace {

nlohmann::ordered_json run_entry(const PlannedRun& run, const std::filesystem::path& out) {
    const RunFolder folder{out / run.path()};
    const nlohmann::ordered_json record = read_run_json(folder.record());
    const RunState state = state_of(run, out);
    nlohmann::ordered_json values = nlohmann::ordered_json::object();
    for (const auto& [key, value] : run.values) values[key] = value;
    return {{"part", run.part},
            {"name", run.name},
            {"folder", run.path()},
            {"values", values},
            {"status", state == RunState::missing ? "missing" : record.value("status", "unknown")},
            {"error", state == RunState::failed ? record.value("error", "") : ""}};
}

/// Not ended by a word of its own: it has no exit code, or that of a request to stop.
bool was_cut_off(const nlohmann::ordered_json& record) {
    const auto code = record.find("exit_code");
    if (code == record.end() || !code->is_number_integer()) return true;
    const int value = code->get<int>();
    return value == static_cast<int>(ExitCode::interrupted) ||
           value == static_cast<int>(ExitCode::terminated);
}

}  // namespace

RunState state_of(const PlannedRun& run, const std::filesystem::path& out) {
    const std::filesystem::path folder = out / run.path();
    const nlohmann::ordered_json record = read_run_json(RunFolder{folder}.record());
    if (record.value("case_hash", "") != run.hash) return RunState::missing;
    const std::string status = record.value("status", "");
    if (status == "done") return RunState::done;
    if (was_cut_off(record) && !CheckpointSets(folder).names().empty()) return RunState::begun;
    return status == "prepared" ? RunState::missing : RunState::failed;
}

void write_study_record(const Study& study, const std::vector<PlannedRun>& plan,
                        const std::filesystem::path& out) {
    auto runs = nlohmann::ordered_json::array();
    for (const PlannedRun& run : plan) runs.push_back(run_entry(run, out));
    write_run_json(out / "study.json",
                   {{"study", study.name}, {"figures", study.figures}, {"runs", runs}});
}

}  // namespace turbidite
