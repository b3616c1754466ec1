// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite check CASE: validate a case; nothing is written.
#include <fmt/format.h>

#include <memory>

#include "launcher/commands/case_summary.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/job/launch_line.hpp"
#include "launcher/job/prepare_run.hpp"

namespace turbidite {
namespace {

struct CheckOptions {
    std::string file;
    std::vector<std::string> overrides;
};

int check(const CheckOptions& options) {
    const ResolvedCase resolved = load_case(options.file, options.overrides);
    require_programs(resolved.settings, needed_programs(resolved.settings, find_programs()));
    fmt::print("{}valid\n", case_summary(resolved));
    return static_cast<int>(ExitCode::done);
}

}  // namespace

CommandAction declare_check(CLI::App& app) {
    const auto options = std::make_shared<CheckOptions>();
    app.add_option("CASE", options->file, "case file (YAML)")->required();
    app.add_option("--set", options->overrides, "key=value, replaces a value of the case")
        ->allow_extra_args(false)
        ->type_name("KEY=VALUE");
    return [options] { return check(*options); };
}

}  // namespace turbidite
