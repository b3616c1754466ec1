// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/run_record.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "coupler/protocol/files/whole_file.hpp"

namespace turbidite {
namespace {

const char* status_word(ExitCode code) {
    switch (code) {
        case ExitCode::done:
            return "done";
        case ExitCode::handshake_refused:
            return "handshake refused";
        case ExitCode::stalled:
            return "stalled";
        case ExitCode::physics_refused:
            return "physics refused";
        case ExitCode::interrupted:
        case ExitCode::terminated:
            return "interrupted";
        default:
            return "failed";
    }
}

nlohmann::ordered_json rank_table(const std::vector<Hello>& ranks) {
    auto table = nlohmann::ordered_json::array();
    for (const Hello& hello : ranks)
        table.push_back({{"role", role_name(hello.role)},
                         {"rank", hello.rank},
                         {"adapter", hello.adapter},
                         {"adapter_version", hello.adapter_version},
                         {"host_code", hello.host_code},
                         {"host", hello.host},
                         {"pid", hello.pid},
                         {"log", hello.log_file}});
    return table;
}

nlohmann::ordered_json maxima_table(const RunMaxima& maxima) {
    const FluidMaxima fluid = maxima.fluid.value_or(FluidMaxima{});
    nlohmann::ordered_json table = {{"penetration", maxima.penetration},
                                    {"grain_balance", maxima.grain_balance},
                                    {"fluid_balance", fluid.balance},
                                    {"divergence", fluid.divergence},
                                    {"unconverged_windows", maxima.unconverged_windows},
                                    {"motion_defect", maxima.motion_defect}};
    if (maxima.contact_violation) table["contact_violation"] = *maxima.contact_violation;
    if (maxima.fluid) {
        table["final_divergence"] = fluid.final_divergence;
        table["courant"] = fluid.courant;
        table["unconverged_multiplier_windows"] = fluid.unconverged_windows;
        table["remaining_divergence"] = fluid.remaining_divergence;
        table["unconverged_splitting_windows"] = fluid.unconverged_splitting_windows;
    }
    if (maxima.joint) {
        table["joint_rounds"] = maxima.joint->rounds;
        table["joint_mismatch"] = maxima.joint->mismatch;
        table["unconverged_joint_windows"] = maxima.joint->unconverged_windows;
    }
    return table;
}

nlohmann::ordered_json contact_table(const RunStatistics& statistics) {
    return {{"unconverged_windows", statistics.maxima.unconverged_windows},
            {"residual_p95", statistics.contact_residuals.quantile(0.95)},
            {"residual_max", statistics.contact_residuals.largest()}};
}

nlohmann::ordered_json warning_list(const std::vector<RunWarning>& warnings) {
    auto list = nlohmann::ordered_json::array();
    for (const RunWarning& warning : warnings)
        list.push_back({{"about", warning.about}, {"text", warning.text}});
    return list;
}

/// The last of the parts of a run; null unless `turbidite` keeps a list of them.
nlohmann::ordered_json* last_part(nlohmann::ordered_json& record) {
    const auto parts = record.find("parts");
    return parts == record.end() || parts->empty() ? nullptr : &parts->back();
}

void write_progress(nlohmann::ordered_json& record, const RunStatus& status) {
    const RunStatistics& statistics = status.statistics;
    record["windows_done"] = statistics.windows_done;
    if (auto* part = last_part(record)) (*part)["windows_done"] = statistics.windows_done;
    record["warnings"] = warning_list(status.warnings);
    record["maxima"] = maxima_table(statistics.maxima);
    if (!statistics.contact_residuals.empty()) record["contact"] = contact_table(statistics);
}

}  // namespace

bool has_verdict(const std::filesystem::path& file) {
    std::ifstream in(file);
    const auto record = nlohmann::json::parse(in, nullptr, false);
    return record.is_object() && record.contains("exit_code") && !record["exit_code"].is_null();
}

void write_run_record(const std::filesystem::path& file, const RunStatus& status,
                      const std::vector<Hello>& ranks) {
    nlohmann::ordered_json record = nlohmann::ordered_json::object();
    if (std::ifstream old(file); old) {
        record = nlohmann::ordered_json::parse(old, nullptr, false);
        if (!record.is_object()) record = nlohmann::ordered_json::object();
    }
    record["status"] = status_word(status.code);
    record["exit_code"] = static_cast<int>(status.code);
    record["error"] = status.reason;
    record["wall_seconds"] = status.wall_seconds;
    record["checkpoints"] = {{"written", status.checkpoints.written},
                             {"seconds", status.checkpoints.seconds}};
    std::int64_t before = 0;
    if (auto* part = last_part(record)) {
        (*part)["status"] = status_word(status.code);
        before = part->value("from_window", before);
    }
    // A part that ends before it has read its checkpoint knows nothing of the windows before it.
    if (status.statistics.windows_done >= before)
        write_progress(record, status);
    else
        record["windows_done"] = before;
    record["ranks"] = rank_table(ranks);
    // Paths need not be UTF-8.
    const auto replace = nlohmann::ordered_json::error_handler_t::replace;
    write_whole_on_disk(
        file, [&](std::ostream& out) { out << record.dump(2, ' ', false, replace) << "\n"; });
}

}  // namespace turbidite
