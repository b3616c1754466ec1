// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite adapter-test -- COMMAND: plays a scripted partner against a grains adapter and says
// which requirements it meets.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "launcher/adapter_test/requirements.hpp"
#include "launcher/case/case_file.hpp"
#include "launcher/case/command_words.hpp"
#include "launcher/case/grains_adapters.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/job/temporary_folder.hpp"

namespace turbidite {
namespace {

struct AdapterTestOptions {
    Candidate candidate;
    std::filesystem::path keep;
    std::vector<std::string> words;
};

/// The second line of a refusal: why.
std::string reason(const std::string& refusal) {
    const auto start = refusal.find("\n  ");
    if (start == std::string::npos) return refusal;
    return refusal.substr(start + 3, refusal.find('\n', start + 1) - start - 3);
}

/// The rules of a shipped adapter refuse a case that it does not support before it starts.
Finding judge(const Requirement& requirement, const Candidate& candidate,
              const std::filesystem::path& folder) {
    try {
        return requirement.judge(candidate, folder);
    } catch (const CaseRefused& refused) {
        const Grade grade = requirement.optional ? Grade::not_supported : Grade::failed;
        return {grade, reason(refused.what())};
    }
}

void check_name(const std::string& adapter) {
    Settings settings;
    settings.set("grains.adapter", adapter);
    grains_adapter(settings);  // throws
}

const char* word(Grade grade) {
    return grade == Grade::met ? "ok" : grade == Grade::failed ? "FAILS" : "-";
}

int test_adapter(AdapterTestOptions options) {
    if (!options.words.empty())
        options.candidate.command =
            command_text(with_absolute_files(options.words, std::filesystem::current_path()));
    if (options.candidate.command.empty() && options.candidate.adapter == "external")
        throw Failure(ExitCode::bad_input,
                      "adapter-test needs a program: turbidite adapter-test -- my-code, or "
                      "--adapter NAME for a shipped one. Exit code 2.");
    check_name(options.candidate.adapter);
    const bool keep = !options.keep.empty();
    std::optional<TemporaryFolder> scratch;
    const auto folder = keep ? options.keep : scratch.emplace("adapter-test").path();
    int failed = 0;
    for (const Requirement& requirement : requirements()) {
        const Finding finding = judge(requirement, options.candidate, folder);
        failed += finding.grade == Grade::failed;
        fmt::print("{:<6}{:<36}{}\n", word(finding.grade), requirement.name, finding.text);
        std::fflush(stdout);
    }
    fmt::print("{}\n",
               failed == 0 ? "conforms" : fmt::format("{} requirements are not met", failed));
    return static_cast<int>(failed == 0 ? ExitCode::done : ExitCode::tests_failed);
}

}  // namespace

CommandAction declare_adapter_test(CLI::App& app) {
    const auto options = std::make_shared<AdapterTestOptions>();
    app.add_option("--adapter", options->candidate.adapter,
                   "a shipped adapter instead of a command")
        ->type_name("NAME");
    app.add_option("--keep", options->keep, "keep the runs in this folder")->type_name("DIR");
    app.add_option("COMMAND", options->words, "program and arguments, after --")->type_name("");
    return [options] { return test_adapter(*options); };
}

}  // namespace turbidite
