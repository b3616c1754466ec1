// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/doctor/short_job.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "launcher/doctor/command_output.hpp"
#include "launcher/job/folder/run_json.hpp"
#include "launcher/job/folder/temporary_folder.hpp"
#include "launcher/job/launch_line.hpp"
#include "launcher/job/overdue.hpp"
#include "launcher/job/play_run.hpp"

namespace turbidite {
namespace {

constexpr auto what = "coupled job";

const std::vector<std::string> few_grains = {
    "domain.size=[6, 6]",   "grains.count=6",  "fluid.cells_per_diameter=4", "time.end=0.25",
    "output.interval=0.25", "limits.start=60", "limits.stall_hard=60"};

std::string remedy(const LaunchSite& site) {
    return (site.programs.installed ? "turbidite" : "./turbidite") + std::string(" run quickstart");
}

JobEnd start(const PreparedRun& prepared) {
    ::setenv("TURBIDITE_PROGRESS", "plain", 1);
    const JobEnd end = run_job({.arguments = under_lock(prepared.line),
                                .error_log = prepared.folder.log("mpirun"),
                                .output_log = prepared.folder.log("output"),
                                .request_stop = [](int) { return false; },
                                .overdue = Overdue(prepared.folder, prepared.settings),
                                .had_children = [&] { return played_here(prepared.folder); }});
    if (end.signal != 0) throw Failure(ExitCode::interrupted, "doctor was interrupted");
    return end;
}

/// Empty if it went well. What follows the first semicolon names files that are removed.
std::string fault(const PreparedRun& prepared) {
    const JobOutcome outcome = settle_outcome(prepared.folder, start(prepared), prepared.ranks);
    return outcome.code == ExitCode::done
               ? ""
               : first_words(outcome.error.substr(0, outcome.error.find(';')));
}

Diagnosis play(const LaunchSite& site, const std::filesystem::path& folder) {
    const auto begin = std::chrono::steady_clock::now();
    const ResolvedCase resolved =
        load_case(site.programs.configs() / "quickstart.yaml", few_grains);
    const PreparedRun prepared = prepare(resolved, {folder / "run", false}, site);
    const std::string refused = fault(prepared);
    if (!refused.empty()) return {Health::wrong, what, refused, remedy(site)};
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    const auto windows = read_run_json(prepared.folder.record()).value("windows_done", 0);
    return {Health::ok, what,
            fmt::format("{} grains, {} windows, {:.1f} s", resolved.population.size(), windows,
                        seconds.count()),
            ""};
}

}  // namespace

Diagnosis play_short_job(const LaunchSite& site) {
    const TemporaryFolder folder("doctor");
    try {
        return play(site, folder.path());
    } catch (const Failure& failure) {
        if (failure.code() == ExitCode::interrupted) throw;
        return {Health::wrong, what, first_words(failure.what()), remedy(site)};
    }
}

}  // namespace turbidite
