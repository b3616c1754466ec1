// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/run_record.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "coupler/protocol/largest.hpp"
#include "coupler/protocol/whole_file.hpp"

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

nlohmann::ordered_json rank_table(const std::vector<ParticipantLink*>& links) {
    auto table = nlohmann::ordered_json::array();
    for (const ParticipantLink* link : links)
        for (int rank = 0; rank < link->ranks(); ++rank) {
            const Hello& hello = link->hello(rank);
            table.push_back({{"role", role_name(link->role())},
                             {"rank", rank},
                             {"adapter", hello.adapter},
                             {"adapter_version", hello.adapter_version},
                             {"host_code", hello.host_code},
                             {"host", hello.host},
                             {"pid", hello.pid},
                             {"log", hello.log_file}});
        }
    return table;
}

nlohmann::ordered_json maxima_table(const RunMaxima& maxima) {
    nlohmann::ordered_json table = {{"penetration", maxima.penetration},
                                    {"grain_balance", maxima.grain_balance},
                                    {"fluid_balance", maxima.fluid_balance},
                                    {"divergence", maxima.divergence},
                                    {"unconverged_windows", maxima.unconverged_windows}};
    if (maxima.joint) {
        table["joint_rounds"] = maxima.joint->rounds;
        table["joint_mismatch"] = maxima.joint->mismatch;
        table["unconverged_joint_windows"] = maxima.joint->unconverged_windows;
    }
    return table;
}

nlohmann::ordered_json contact_table(const RunStatus& status) {
    return {{"unconverged_windows", status.maxima.unconverged_windows},
            {"residual_p95", status.contact_residuals.quantile(0.95)},
            {"residual_max", status.contact_residuals.largest()}};
}

}  // namespace

void ContactResiduals::take_in(const ContactReport& report) {
    if (!report.residual) return;
    const bool worst = std::isnan(*report.residual);  // which has no place in an order
    values_.push_back(worst ? INFINITY : *report.residual);
}

double ContactResiduals::largest() const {
    return values_.empty() ? 0.0 : *std::max_element(values_.begin(), values_.end());
}

double ContactResiduals::quantile(double share) const {
    if (values_.empty()) return 0.0;
    std::vector<double> sorted = values_;
    const auto rank =
        static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(sorted.size()))) - 1;
    const auto at = sorted.begin() + std::max<std::ptrdiff_t>(rank, 0);
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at;
}

void RunMaxima::take_in(const JointReport& report, double velocity) {
    if (!joint) joint.emplace();
    joint->rounds = std::max(joint->rounds, report.rounds);
    joint->mismatch = largest(joint->mismatch, report.mismatch / velocity);
    joint->unconverged_windows += report.converged ? 0 : 1;
}

bool has_verdict(const std::filesystem::path& file) {
    std::ifstream in(file);
    const auto record = nlohmann::json::parse(in, nullptr, false);
    return record.is_object() && record.contains("exit_code") && !record["exit_code"].is_null();
}

void write_run_record(const std::filesystem::path& file, const RunStatus& status,
                      const std::vector<ParticipantLink*>& links) {
    nlohmann::ordered_json record = nlohmann::ordered_json::object();
    if (std::ifstream old(file); old) {
        record = nlohmann::ordered_json::parse(old, nullptr, false);
        if (!record.is_object()) record = nlohmann::ordered_json::object();
    }
    record["status"] = status_word(status.code);
    record["exit_code"] = static_cast<int>(status.code);
    record["error"] = status.reason;
    record["windows_done"] = status.windows_done;
    record["wall_seconds"] = status.wall_seconds;
    record["maxima"] = maxima_table(status.maxima);
    if (!status.contact_residuals.empty()) record["contact"] = contact_table(status);
    record["ranks"] = rank_table(links);
    write_whole(file, [&](std::ostream& out) { out << record.dump(2) << "\n"; });
}

}  // namespace turbidite
