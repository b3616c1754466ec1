// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/overdue.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <utility>

#include "coupler/protocol/files/run_files.hpp"
#include "coupler/protocol/files/start_record.hpp"
#include "coupler/protocol/host_name.hpp"
#include "launcher/job/folder/run_json.hpp"
#include "launcher/job/terminal.hpp"

namespace turbidite {
namespace {

constexpr auto start_limit = "limits.start";
constexpr auto end_limit = "limits.stall_hard";

/// The coupler has written its verdict, or a program has ended before that.
bool is_over(const RunFolder& folder) {
    if (read_first_end(folder.root)) return true;
    const auto record = read_run_json(folder.record());
    return record.contains("exit_code") && !record["exit_code"].is_null();
}

/// Programs that have not come to their MPI_Finalize. A role that the job does not play has no
/// records.
std::vector<StartRecord> staying(const RunFolder& folder, const Settings& settings) {
    auto late = not_yet_at(StartStep::end, folder.root, {Role::fluid, Role::grains}, settings);
    std::erase_if(late, [](const StartRecord& record) {
        // Signal 0 asks whether the process exists; on other hosts nobody can be asked.
        return record.host == host_name() && kill(static_cast<pid_t>(record.pid), 0) != 0;
    });
    return late;
}

}  // namespace

bool played_here(const RunFolder& folder) {
    const auto hosts = hosts_of_started(folder.root);
    return !hosts.empty() && std::all_of(hosts.begin(), hosts.end(), [](const std::string& host) {
        return host == host_name();
    });
}

Overdue::Overdue(RunFolder folder, Settings settings)
    : folder_(std::move(folder)), settings_(std::move(settings)) {}

bool Overdue::past(Clock::time_point from, const char* limit) const {
    return std::chrono::duration<double>(Clock::now() - from).count() > settings_.real(limit);
}

bool Overdue::has_not_begun() {
    begun_ = begun_ || !hosts_of_started(folder_.root).empty();
    return !begun_ && past(ordered_, start_limit);
}

bool Overdue::operator()() {
    if (has_not_begun()) return true;  // told by settle_outcome
    if (!over_ && !is_over(folder_)) return false;
    if (!over_) over_ = Clock::now();
    if (!past(*over_, end_limit)) return false;
    print_on_stderr(late_end_text(staying(folder_, settings_), settings_.real(end_limit)) + "\n");
    return true;
}

}  // namespace turbidite
