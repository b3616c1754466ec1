// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite resume DIR: goes on with a run from its last whole checkpoint.
#include <fmt/format.h>

#include <memory>

#include "launcher/commands/command.hpp"
#include "launcher/job/job.hpp"
#include "launcher/job/resume_run.hpp"
#include "launcher/job/terminal.hpp"

namespace turbidite {
namespace {

struct ResumeOptions {
    std::string folder;
    std::vector<std::string> overrides;
    bool dry_run = false;
};

int resume(const ResumeOptions& options) {
    hold_announcements();
    const auto tell = [&](const std::string& text) {
        options.dry_run ? print_on_stderr(for_stderr(text)) : fmt::print("{}", for_stdout(text));
    };
    const LaunchSite site = this_site();
    const auto resumed =
        prepare_resumption(options.folder, options.overrides, site, tell_on_stderr);
    if (!resumed) {
        tell(fmt::format(
            "The run in {} is complete. To go on beyond its end: --set time.end=<t_c>.\n",
            options.folder));
        return static_cast<int>(ExitCode::done);
    }
    tell(fmt::format("{} goes on after window {}, {:g} t_c\n", resumed->run.folder.root.string(),
                     resumed->windows, resumed->time));
    if (!options.dry_run) {
        const ExitCode code = play(resumed->run, site.programs).code;
        if (take_back_overrides(*resumed, code))
            tell_on_stderr(
                fmt::format("No window is left that was played with {}: the folder has "
                            "the values again that it had before.\n",
                            fmt::join(options.overrides, ", ")));
        return static_cast<int>(code);
    }
    std::fflush(nullptr);
    fmt::print("{}\n", shell_line(resumed->run.line));
    return static_cast<int>(ExitCode::done);
}

}  // namespace

CommandAction declare_resume(CLI::App& app) {
    const auto options = std::make_shared<ResumeOptions>();
    app.add_option("DIR", options->folder, "run folder")->required();
    add_overrides(app, options->overrides,
                  "key=value, for the few keys that a run may change, as time.end; may be "
                  "repeated");
    app.add_flag("--dry-run", options->dry_run,
                 "prepare everything and print the mpirun line instead of starting it; the folder "
                 "keeps the keys of --set, and its run is not done until it has gone on");
    return [options] { return resume(*options); };
}

}  // namespace turbidite
