// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite report DIR [--film]: creates report.html, and on request a film, from a run folder.
#include <fmt/format.h>

#include <memory>

#include "launcher/commands/command.hpp"
#include "launcher/commands/report_script.hpp"

namespace turbidite {
namespace {

/// The film comes after the page, which is there even if the film fails.
int film(const RunFolder& folder) {
    const ExitCode code = write_film(folder, find_programs());
    if (code == ExitCode::done) fmt::print("{}\n", folder.film().string());
    return static_cast<int>(code);
}

int report(const std::string& directory, bool with_film) {
    require_run_folder(directory);
    const RunFolder folder{std::filesystem::absolute(directory)};
    if (!write_report(folder, find_programs()))
        throw Failure(ExitCode::participant_failed, "report.html could not be written; see above.");
    fmt::print("{}\n", folder.report().string());
    return with_film ? film(folder) : static_cast<int>(ExitCode::done);
}

}  // namespace

CommandAction declare_report(CLI::App& app) {
    const auto directory = std::make_shared<std::string>();
    app.add_option("DIR", *directory, "run folder")->required();
    const auto with_film = std::make_shared<bool>(false);
    app.add_flag("--film", *with_film,
                 "also write DIR/film.webp, a picture of every output one after the other");
    return [directory, with_film] { return report(*directory, *with_film); };
}

}  // namespace turbidite
