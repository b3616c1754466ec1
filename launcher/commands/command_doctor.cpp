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

void print(const Diagnosis& diagnosis) {
    std::string lines =
        fmt::format("{:<8}{:<28}{}\n", word(diagnosis.health), diagnosis.name, diagnosis.text);
    if (!diagnosis.remedy.empty()) lines += fmt::format("        {}\n", diagnosis.remedy);
    fmt::print("{}", for_stdout(lines));
    std::fflush(stdout);
}

bool any(const Diagnoses& diagnoses, Health health) {
    return std::any_of(diagnoses.begin(), diagnoses.end(),
                       [&](const Diagnosis& diagnosis) { return diagnosis.health == health; });
}

/// Prints as it finds, since some diagnoses take seconds.
class Sheet {
 public:
    void add(const Diagnoses& diagnoses) {
        for (const Diagnosis& diagnosis : diagnoses) print(diagnosis);
        all_.insert(all_.end(), diagnoses.begin(), diagnoses.end());
    }

    bool any(Health health) const { return turbidite::any(all_, health); }

 private:
    Diagnoses all_;
};

Diagnosis job_of(const Sheet& sheet, const LaunchSite& site) {
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
    const Diagnoses built = built_programs(site.programs);
    sheet.add(built);
    if (!site.programs.installed && any(built, Health::missing)) sheet.add(build_tools());
    sheet.add(state_of_machine(site));
    const bool ready = !sheet.any(Health::missing) && !sheet.any(Health::wrong);
    Diagnosis job{Health::not_tried, "coupled job", "--no-job", ""};
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
