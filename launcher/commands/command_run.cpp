// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite run CASE: validate, prepare the run folder, start the job, report.
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <memory>

#include "launcher/commands/case_summary.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/job/job.hpp"
#include "launcher/job/job_outcome.hpp"
#include "launcher/job/launch_line.hpp"
#include "launcher/job/prepare_run.hpp"
#include "launcher/report/report_script.hpp"

namespace turbidite {
namespace {

struct RunOptions {
    std::string file;
    std::vector<std::string> overrides;
    std::string from;  ///< DIR[@time]
    RunOrder order;
    bool dry_run = false;
};

// The coupler looks for this file before every window and ends the run with the code in it.
void request_stop(const RunFolder& folder, int signal) {
    const ExitCode code = signal == SIGINT ? ExitCode::interrupted : ExitCode::terminated;
    std::ofstream file(folder.stop());
    file << static_cast<int>(code) << "\n";
    file.close();
    const char* answer =
        file ? "Stopping after the next window" : "The wish to stop cannot be written";
    fmt::print(stderr, "\n{}; once more to kill the job.\n", answer);
}

struct PreparedRun {
    RunFolder folder;
    std::vector<std::string> line;
    std::vector<std::string> ranks;
};

int run_to_the_end(const PreparedRun& prepared, const Programs& programs) {
    const RunFolder& folder = prepared.folder;
    ::setenv("TURBIDITE_PROGRESS", isatty(STDOUT_FILENO) ? "terminal" : "plain", 1);
    const JobEnd end = run_job({.arguments = prepared.line,
                                .error_log = folder.log("mpirun"),
                                .request_stop = [&](int s) { request_stop(folder, s); }});
    const JobOutcome outcome = settle_outcome(folder, end, prepared.ranks);
    const bool reported = write_report(folder, programs);
    std::fflush(stdout);
    const bool done = outcome.code == ExitCode::done;
    fmt::print(done ? stdout : stderr, "{}", outcome_text(folder, outcome));
    if (!reported) fmt::print(stderr, "report.html could not be written; see above.\n");
    return static_cast<int>(outcome.code);
}

int run(const RunOptions& options) {
    const ResolvedCase resolved = load_case(options.file, options.overrides, options.from);
    const LaunchSite site = this_site();
    require_programs(resolved.settings, needed_programs(resolved.settings, site.programs));
    const RunFolder folder = make_run_folder(options.order, resolved.name);
    const auto line = launch_arguments(resolved.settings, folder, site);
    prepare_run(resolved, folder, line);
    fmt::print(options.dry_run ? stderr : stdout, "{}  folder: {}\n", case_summary(resolved),
               folder.root.string());
    std::fflush(nullptr);
    if (!options.dry_run)
        return run_to_the_end({folder, line, rank_names(resolved.settings)}, site.programs);
    fmt::print("{}\n", shell_line(line));
    return static_cast<int>(ExitCode::done);
}

}  // namespace

CommandAction declare_run(CLI::App& app) {
    const auto options = std::make_shared<RunOptions>();
    app.add_option("CASE", options->file, "case file (YAML)")->required();
    app.add_option("--set", options->overrides,
                   "key=value, replaces a value of the case; may be repeated (see turbidite keys)")
        ->allow_extra_args(false)
        ->type_name("KEY=VALUE");
    app.add_option("--from", options->from,
                   "start from the grains of another run, at its end or at an output time [t_c]")
        ->type_name("DIR[@TIME]");
    app.add_option("--out", options->order.out,
                   "run folder, new or empty; default runs/<case>-<date>-<time>")
        ->type_name("DIR");
    app.add_flag("--force", options->order.force, "overwrite the run that is in --out");
    app.add_flag("--dry-run", options->dry_run,
                 "prepare everything and print the mpirun line instead of starting it");
    return [options] { return run(*options); };
}

}  // namespace turbidite
