// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite doctor: what is installed and built, whether it fits together, and a short job.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "coupler/protocol/failure.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/doctor/built.hpp"
#include "launcher/doctor/installed.hpp"
#include "launcher/doctor/machine.hpp"
#include "launcher/doctor/short_job.hpp"
#include "launcher/job/terminal.hpp"

namespace turbidite {
namespace {

struct DoctorOptions {
    bool no_job = false;
};

const char* word(Health health) {
    switch (health) {
        case Health::ok:
            return "ok";
        case Health::missing:
            return "missing";
        case Health::wrong:
            return "wrong";
        default:
            return "-";
    }
}

void print(const Finding& finding) {
    std::string lines =
        fmt::format("{:<8}{:<28}{}\n", word(finding.health), finding.name, finding.text);
    if (!finding.remedy.empty()) lines += fmt::format("        {}\n", finding.remedy);
    fmt::print("{}", for_stdout(lines));
    std::fflush(stdout);
}

bool any(const Findings& findings, Health health) {
    return std::any_of(findings.begin(), findings.end(),
                       [&](const Finding& finding) { return finding.health == health; });
}

/// Prints as it finds, since some findings take seconds.
class Sheet {
 public:
    void add(const Findings& findings) {
        for (const Finding& finding : findings) print(finding);
        all_.insert(all_.end(), findings.begin(), findings.end());
    }

    bool any(Health health) const { return turbidite::any(all_, health); }

 private:
    Findings all_;
};

Finding job_of(const Sheet& sheet, const LaunchSite& site) {
    if (sheet.any(Health::missing))
        return {Health::not_tried, "coupled job", "needs what is missing", ""};
    return play_short_job(site);
}

int tell(ExitCode code, const std::string& verdict) {
    fmt::print("{}", for_stdout(verdict + "\n"));
    return static_cast<int>(code);
}

int examine(const DoctorOptions& options) {
    const LaunchSite site = this_site();
    Sheet sheet;
    sheet.add(installed_software(site));
    const Findings built = built_programs(site.programs);
    sheet.add(built);
    if (!site.programs.installed && any(built, Health::missing)) sheet.add(build_tools());
    sheet.add(state_of_machine(site));
    const bool ready = !sheet.any(Health::missing) && !sheet.any(Health::wrong);
    Finding job{Health::not_tried, "coupled job", "--no-job", ""};
    if (!options.no_job) job = job_of(sheet, site);
    sheet.add({job});
    if (job.health == Health::wrong)
        return tell(ExitCode::participant_failed, "The job failed. Exit code 4.");
    if (!ready)
        return tell(ExitCode::bad_input, "Not all is well; the commands above help. Exit code 2.");
    return tell(ExitCode::done, "all is well");
}

}  // namespace

CommandAction declare_doctor(CLI::App& app) {
    const auto options = std::make_shared<DoctorOptions>();
    app.add_flag("--no-job", options->no_job, "without the short job at the end");
    return [options] { return examine(*options); };
}

}  // namespace turbidite
