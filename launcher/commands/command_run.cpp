// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite run CASE: validate, prepare the run folder, start the job, report.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "coupler/protocol/failure.hpp"
#include "launcher/case/forecast/disk_cost.hpp"
#include "launcher/commands/case_summary.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/job/folder/shipped_cases.hpp"
#include "launcher/job/job.hpp"
#include "launcher/job/play_run.hpp"
#include "launcher/job/pour_grains.hpp"
#include "launcher/job/terminal.hpp"
#include "launcher/study/study_file.hpp"

namespace turbidite {
namespace {

struct RunOptions {
    std::string file;
    std::vector<std::string> overrides;
    std::string from;  ///< DIR[@time]
    RunOrder order;
    bool dry_run = false;
};

/// What a program and its children write to stdout goes to stderr meanwhile.
class OnStderr {
 public:
    OnStderr() : stdout_(::dup(STDOUT_FILENO)) {
        std::fflush(stdout);
        ::dup2(STDERR_FILENO, STDOUT_FILENO);
    }
    ~OnStderr() {
        std::fflush(stdout);
        ::dup2(stdout_, STDOUT_FILENO);
        ::close(stdout_);
    }
    OnStderr(const OnStderr&) = delete;
    OnStderr& operator=(const OnStderr&) = delete;

 private:
    int stdout_;
};

/// Of a dry run stdout is the line and nothing else: it may go to a shell.
ResolvedCase resolved_case(const RunOptions& options, const LaunchSite& site) {
    ResolvedCase planned = load_case(options.file, options.overrides, options.from);
    std::optional<OnStderr> moved;
    if (options.dry_run) moved.emplace();
    return with_poured_grains(std::move(planned), site);
}

void require_case(const std::filesystem::path& file) {
    if (!is_study(file)) return;
    throw Failure(
        ExitCode::bad_input,
        fmt::format("turbidite: {0} is a study of several runs\n  Play it with: turbidite "
                    "study {0}",
                    shell_line({file.string()})));
}

int run(const RunOptions& options) {
    require_case(options.file);
    hold_announcements();
    const LaunchSite site = this_site();
    const ResolvedCase resolved = resolved_case(options, site);
    const auto folder =
        options.order.out.empty() ? std::filesystem::path("runs") : options.order.out;
    if (const std::string lack = lack_of_disk(predicted_disk(resolved), folder); !lack.empty())
        tell_on_stderr(lack);
    const PreparedRun prepared = prepare(resolved, options.order, site);
    const std::string summary =
        case_summary(resolved) + fmt::format("  folder: {}\n", prepared.folder.root.string());
    if (!options.dry_run) {
        fmt::print("{}", for_stdout(summary));
        return static_cast<int>(play(prepared, site.programs).code);
    }
    print_on_stderr(for_stderr(summary));
    fmt::print("{}\n", shell_line(prepared.line));
    return static_cast<int>(ExitCode::done);
}

}  // namespace

CommandAction declare_run(CLI::App& app) {
    const auto options = std::make_shared<RunOptions>();
    app.add_option("CASE", options->file, "case file (YAML), or the name of a shipped case")
        ->required();
    add_overrides(app, options->overrides,
                  "key=value, replaces a value of the case; may be repeated (see turbidite keys)");
    app.add_option("--from", options->from,
                   "start from the grains of another run, at its end or at an output time [t_c]")
        ->type_name("DIR[@TIME]")
        // An empty variable of a script would begin with other grains.
        ->check([](const std::string& given) {
            return given.empty() ? "it is empty; give the folder of a run" : "";
        });
    app.add_option("--out", options->order.out,
                   "run folder, new or empty; default runs/<case>-<date>-<time>")
        ->type_name("DIR");
    app.add_flag("--force", options->order.force, "overwrite an existing run in --out");
    app.add_flag(
        "--dry-run", options->dry_run,
        "prepare everything, poured grains too, and print the mpirun line instead of starting it");
    return [options] {
        options->file = case_named(options->file, find_programs());
        return run(*options);
    };
}

}  // namespace turbidite
