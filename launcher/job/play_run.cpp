// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/play_run.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <stdio_ext.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "coupler/protocol/files/run_files.hpp"
#include "coupler/protocol/files/whole_file.hpp"
#include "launcher/case/forecast/mesh_cost.hpp"
#include "launcher/case/grains/packing/pouring.hpp"
#include "launcher/commands/report_script.hpp"
#include "launcher/job/folder/foam_warnings.hpp"
#include "launcher/job/folder/run_json.hpp"
#include "launcher/job/job.hpp"
#include "launcher/job/launch_line.hpp"
#include "launcher/job/overdue.hpp"
#include "launcher/job/terminal.hpp"

namespace turbidite {
namespace {

// The coupler looks for this file before every window and ends the run with the code in it: the
// file appears with its code. Before the history begins there is no coupler to look for it, and
// nothing to keep.
bool request_stop(const RunFolder& folder, int signal) {
    std::error_code unread;  // not now, as on a file system that is away for a moment
    if (!std::filesystem::exists(folder.history(), unread) && !unread) return false;
    const ExitCode code = signal == SIGINT ? ExitCode::interrupted : ExitCode::terminated;
    std::string answer = "Stopping after the next window";
    try {
        write_whole(folder.stop(),
                    [code](std::ostream& file) { file << static_cast<int>(code) << "\n"; });
    } catch (const Failure& failure) {
        answer = failure.what();
    }
    print_on_stderr(fmt::format("\n{}; interrupt again to kill the job.\n", answer));
    return true;
}

/// A run has succeeded whether or not what it said on the way could be written.
void forget_what_nobody_reads() {
    if (stdout_took_all()) return;
    __fpurge(stdout);
    std::clearerr(stdout);
}

/// Something to report on: a row of the history.
bool has_output(const RunFolder& folder) {
    std::ifstream history(folder.history());
    std::string header, row;
    return std::getline(history, header) && std::getline(history, row);
}

/// What OpenFOAM's own parts warned of since the job started, to the user and into run.json.
void tell_foam_warnings(const RunFolder& folder, const Settings& settings) {
    if (!has_openfoam(settings)) return;
    const int ranks = static_cast<int>(settings.integer("fluid.ranks"));
    const auto log = log_file(folder.root, Role::fluid, 0, ranks);
    const std::string text =
        foam_warning_text(foam_warnings(log), std::filesystem::relative(log, folder.root).string());
    if (text.empty()) return;
    print_on_stderr(fmt::format("turbidite: warning: {}\n", text));
    auto record = read_run_json(folder.record());
    auto others = nlohmann::ordered_json::array();
    for (const auto& one : record.value("warnings", others))
        if (one.value("about", "") != "openfoam") others.push_back(one);  // of an earlier part
    others.push_back({{"about", "openfoam"}, {"text", text}});
    record["warnings"] = others;
    try {
        write_run_json(folder.record(), record);
    } catch (const Failure& failure) {
        print_on_stderr(std::string(failure.what()) + "\n");
    }
}

}  // namespace

PreparedRun prepare(const ResolvedCase& resolved, const RunOrder& order, const LaunchSite& site) {
    require_programs(resolved, needed_programs(resolved.settings, site.programs));
    RunOrder own = order;
    own.for_openfoam = has_openfoam(resolved.settings);
    return fill(resolved, own_run_folder(own, resolved.name), site);
}

PreparedRun fill(const ResolvedCase& resolved, const OwnFolder& own, const LaunchSite& site) {
    // The grains of such a case only take the place of poured ones.
    if (is_poured(resolved.settings))
        throw Failure(ExitCode::bad_input,
                      own.folder.root.string() + ": its grains are not poured");
    const auto line = launch_arguments(resolved.settings, own.folder, site);
    prepare_run(resolved, own.folder, line,
                site.programs.scripted_fluid ? FluidMesh::left_out : FluidMesh::built);
    add_view(own.folder, site.programs);
    return {own.folder, own.lock, line, rank_names(resolved.settings), resolved.settings};
}

JobOutcome play(const PreparedRun& prepared, const Programs& programs) {
    const RunFolder& folder = prepared.folder;
    const PipesMayBreak until_reported;
    std::fflush(nullptr);
    ::setenv("TURBIDITE_PROGRESS", rewrites_lines() ? "terminal" : "plain", 1);
    // YADE does not start without one, as in containers and units of systemd.
    ::setenv("HOME", folder.root.c_str(), 0);
    const JobEnd end = run_job({.arguments = under_lock(prepared.line),
                                .error_log = folder.log("mpirun"),
                                .request_stop = [&](int s) { return request_stop(folder, s); },
                                .overdue = Overdue(folder, prepared.settings),
                                .had_children = [&] { return played_here(folder); }});
    JobOutcome outcome = settle_outcome(folder, end, prepared.ranks);
    outcome.signal = end.signal;
    std::fflush(stdout);
    tell_foam_warnings(folder, prepared.settings);
    const bool done = outcome.code == ExitCode::done;
    std::error_code unread;
    if (done) std::filesystem::remove(folder.stop(), unread);  // asked for after the last window
    if (!done) print_on_stderr(for_stderr(outcome_text(folder, outcome)));
    const bool due = report_wanted() && has_output(folder);
    const bool reported = !due || write_report(folder, programs);
    if (done) std::fputs(for_stdout(outcome_text(folder, outcome)).c_str(), stdout);
    if (!reported) print_on_stderr("report.html could not be written; see above.\n");
    forget_what_nobody_reads();
    return outcome;
}

}  // namespace turbidite
