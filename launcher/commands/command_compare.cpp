// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite compare DIR DIR...: one page with the same quantities of several runs, seeds
// averaged.
#include <fmt/format.h>

#include <memory>

#include "launcher/case/files/file_names.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/commands/report_script.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

struct CompareOptions {
    std::vector<std::string> directories;
    std::string page = "compare.html";
    bool each = false;
};

void require_folder_of(const fs::path& page) {
    const fs::path folder = fs::absolute(page).parent_path();
    if (is_folder(folder)) return;
    throw Failure(ExitCode::bad_input,
                  fmt::format("--out = {}: there is no folder {}\n  Make it, or name a file in "
                              "another. Exit code 2.",
                              page.string(), folder.string()));
}

// The numbers are written beside the page under the same base name, so the page must not have their
// ending.
void require_page_name(const fs::path& page) {
    if (page.extension() == ".html") return;
    throw Failure(ExitCode::bad_input,
                  fmt::format("--out = {} does not end in .html\n  The numbers are written beside "
                              "the page as .csv and .json. Name a file like compare.html. Exit "
                              "code 2.",
                              page.string()));
}

int compare(const CompareOptions& options) {
    if (options.directories.size() < 2)
        throw Failure(ExitCode::bad_input,
                      "turbidite compare needs at least two run folders\n  For one there is "
                      "turbidite report. Exit code 2.");
    require_page_name(options.page);
    require_folder_of(options.page);
    std::vector<RunFolder> runs;
    for (const std::string& directory : options.directories) {
        require_run_folder(directory);
        runs.push_back({fs::weakly_canonical(directory)});
    }
    const fs::path page = fs::absolute(options.page);
    const ExitCode code = write_comparison(page, runs, options.each, find_programs());
    if (code == ExitCode::done) fmt::print("{}\n", page.string());
    return static_cast<int>(code);
}

}  // namespace

CommandAction declare_compare(CLI::App& app) {
    const auto options = std::make_shared<CompareOptions>();
    app.add_option("DIR", options->directories, "run folders; differences are from the first")
        ->required();
    app.add_option("--out", options->page,
                   "the page to write; its numbers beside it as .csv and .json")
        ->type_name("FILE")
        ->capture_default_str();
    app.add_flag(
        "--each", options->each,
        "every run separately; otherwise runs whose cases differ only in random.seed are averaged");
    return [options] { return compare(*options); };
}

}  // namespace turbidite
