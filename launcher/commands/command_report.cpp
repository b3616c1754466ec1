// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite report DIR: creates report.html from a run folder.
#include <fmt/format.h>

#include <memory>

#include "launcher/commands/command.hpp"
#include "launcher/report/report_script.hpp"

namespace turbidite {
namespace {

int report(const std::string& directory) {
    require_run_folder(directory);
    const RunFolder folder{std::filesystem::absolute(directory)};
    if (!write_report(folder, find_programs()))
        throw Failure(ExitCode::participant_failed, "report.html could not be written; see above.");
    fmt::print("{}\n", folder.report().string());
    return static_cast<int>(ExitCode::done);
}

}  // namespace

CommandAction declare_report(CLI::App& app) {
    const auto directory = std::make_shared<std::string>();
    app.add_option("DIR", *directory, "run folder")->required();
    return [directory] { return report(*directory); };
}

}  // namespace turbidite
