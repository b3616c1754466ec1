// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite new FILE: a case of one's own, beginning with a shipped one.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "coupler/protocol/failure.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/job/folder/shipped_cases.hpp"
#include "launcher/job/launch_line.hpp"
#include "launcher/own_case/own_case.hpp"
#include "launcher/study/study_file.hpp"

namespace turbidite {
namespace {

struct NewOptions {
    std::filesystem::path file;
    std::string like = "quickstart";
};

int write_new(NewOptions options) {
    const std::filesystem::path shipped = case_named(options.like, find_programs());
    if (!std::filesystem::is_regular_file(shipped))
        throw Failure(ExitCode::bad_input,
                      fmt::format("turbidite: there is no file {}\n  --like names a shipped case "
                                  "or study, or the file of one. Exit code 2.",
                                  shipped.string()));
    if (!options.file.has_filename())
        throw Failure(ExitCode::bad_input,
                      fmt::format("turbidite: new \"{}\" names no file\n  Give a name, as in "
                                  "turbidite new my-case.yaml.",
                                  options.file.string()));
    if (const auto ending = options.file.extension(); ending != ".yaml" && ending != ".yml")
        options.file += ".yaml";
    const OwnCase own = write_own_case(shipped, options.file);
    fmt::print("{}\n", own.file.string());
    for (const auto& file : own.beside) fmt::print("{}\n", file.string());
    const std::string name = shell_line({own.file.string()});
    fmt::print("Next: turbidite check {0}; turbidite {1} {0}\n", name,
               is_study(own.file) ? "study" : "run");
    return static_cast<int>(ExitCode::done);
}

}  // namespace

CommandAction declare_new(CLI::App& app) {
    const auto options = std::make_shared<NewOptions>();
    app.add_option("FILE", options->file, "the file to write; .yaml is added")->required();
    app.add_option("--like", options->like, "shipped case or study to begin with")
        ->type_name("NAME")
        ->capture_default_str();
    app.footer("Shipped: " + fmt::format("{}", fmt::join(shipped_cases(find_programs()), ", ")) +
               ".");
    return [options] { return write_new(*options); };
}

}  // namespace turbidite
