// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite check FILE: validate a case or a study; nothing is written.
#include <fmt/format.h>

#include <memory>

#include "launcher/case/forecast/run_cost.hpp"
#include "launcher/case/grains/packing/pouring.hpp"
#include "launcher/commands/case_summary.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/job/folder/shipped_cases.hpp"
#include "launcher/job/launch_line.hpp"
#include "launcher/job/pour_grains.hpp"
#include "launcher/job/prepare_run.hpp"
#include "launcher/job/terminal.hpp"
#include "launcher/study/study_plan.hpp"

namespace turbidite {
namespace {

struct CheckOptions {
    std::string file;
    std::vector<std::string> overrides;
    bool quick = false;
};

int check_study(const CheckOptions& options) {
    const Study study = read_study(options.file);
    const std::vector<PlannedRun> plan = plan_study(study, options.overrides, options.quick);
    std::vector<const PlannedRun*> all;
    for (const PlannedRun& run : plan) {
        const ResolvedCase resolved = run.resolve();
        require_programs(resolved, needed_programs(resolved.settings, find_programs()));
        if (is_poured(resolved.settings)) pouring_case(resolved);
        fmt::print("  {:>7}  {}\n", rough_time(run.seconds), run.path());
        all.push_back(&run);
    }
    fmt::print("{}: {} runs, {}\n{}valid\n", study.name, plan.size(), forecast_text(all),
               for_stdout(remarks_text(plan)));
    return static_cast<int>(ExitCode::done);
}

int check(const CheckOptions& options) {
    if (is_study(options.file)) return check_study(options);
    const ResolvedCase resolved = load_case(options.file, options.overrides);
    require_programs(resolved, needed_programs(resolved.settings, find_programs()));
    if (is_poured(resolved.settings)) pouring_case(resolved);
    fmt::print("{}valid\n", for_stdout(case_summary(resolved)));
    return static_cast<int>(ExitCode::done);
}

}  // namespace

CommandAction declare_check(CLI::App& app) {
    const auto options = std::make_shared<CheckOptions>();
    app.add_option("FILE", options->file, "case or study file (YAML), or the name of a shipped one")
        ->required();
    add_overrides(app, options->overrides, "key=value, replaces a value of the case");
    app.add_flag("--quick", options->quick, "the quick form of a study");
    return [options] {
        options->file = case_named(options->file, find_programs());
        return check(*options);
    };
}

}  // namespace turbidite
