// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite adapter-test -- COMMAND: plays a scripted partner against a grains adapter, or with
// --side fluid against a fluid, and says which requirements it meets.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "coupler/keys/nearest_name.hpp"
#include "launcher/adapter_test/requirements.hpp"
#include "launcher/case/case_file.hpp"
#include "launcher/case/files/command_words.hpp"
#include "launcher/case/grains/grains_adapters.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/job/folder/temporary_folder.hpp"
#include "launcher/job/terminal.hpp"

namespace turbidite {
namespace {

struct AdapterTestOptions {
    Candidate candidate;
    std::filesystem::path keep;
    std::string side = "grains", only;
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

const char* word(Grade grade) {
    return grade == Grade::met ? "ok" : grade == Grade::failed ? "FAILS" : "-";
}

std::string conclusion(int failed) {
    if (failed == 0) return "conforms";
    return fmt::format("{} {} not met", failed,
                       failed == 1 ? "requirement is" : "requirements are");
}

Failure refused(const std::string& text) {
    return Failure(ExitCode::bad_input, "adapter-test " + text + " Exit code 2.");
}

bool is_fluid(const std::string& name) {
    return name == "openfoam" || name == "box";
}

void check_grains(const std::string& name) {
    std::vector<std::string> known;
    for (const GrainsAdapter& adapter : grains_adapters())
        if (adapter.available()) known.push_back(adapter.name);
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    if (is_fluid(name)) throw refused("plays the fluid " + name + " with --side fluid.");
    throw refused(fmt::format("knows no grains adapter \"{}\"; there are {}. Do you mean {}?", name,
                              fmt::join(known, ", "),
                              fmt::join(nearest_names(name, known), " or ")));
}

void check_fluid(const Candidate& candidate) {
    const std::string& name = candidate.adapter;
    if (name == users_program) return;
    if (!is_fluid(name))
        throw refused("knows no fluid \"" + name + "\"; there are openfoam and box.");
    if (name == "openfoam") return;
    if (candidate.dimension == 2)
        throw refused("plays the box program in space only: add --dimension 3.");
}

/// Which program is meant. Throws Failure (bad input).
Candidate candidate_of(const AdapterTestOptions& options) {
    Candidate candidate = options.candidate;
    candidate.side = options.side == "fluid" ? Role::fluid : Role::grains;
    candidate.words = with_absolute_files(options.words, std::filesystem::current_path());
    if (!candidate.words.empty() && candidate.adapter != users_program)
        throw refused(
            fmt::format("plays the shipped adapter {} or a program, not both: leave out "
                        "--adapter, or {}.",
                        candidate.adapter, candidate.words.front()));
    if (candidate.side == Role::grains && candidate.words.empty() &&
        candidate.adapter == users_program)
        throw refused(
            "needs a program: turbidite adapter-test -- my-code, or --adapter NAME for a shipped "
            "one, or --side fluid for the shipped fluid.");
    if (candidate.side == Role::fluid && !candidate.words.empty() &&
        find_program_file(candidate.words.front()).empty())
        throw refused("finds no executable program " + candidate.words.front() + ".");
    candidate.side == Role::grains ? check_grains(candidate.adapter) : check_fluid(candidate);
    return candidate;
}

/// Those whose name contains `only`. Throws Failure (bad input) if there is none.
std::vector<Requirement> chosen(const Candidate& candidate, const std::string& only) {
    std::vector<Requirement> all =
        candidate.side == Role::fluid ? fluid_requirements() : grains_requirements();
    std::string names;
    for (const Requirement& requirement : all) names += std::string("\n  ") + requirement.name;
    std::erase_if(all, [&](const Requirement& requirement) {
        return std::string(requirement.name).find(only) == std::string::npos;
    });
    if (all.empty()) throw refused("has no requirement \"" + only + "\"; there are" + names);
    return all;
}

int test_adapter(const AdapterTestOptions& options) {
    const Candidate candidate = candidate_of(options);
    const std::vector<Requirement> requirements = chosen(candidate, options.only);
    std::optional<TemporaryFolder> scratch;
    const auto folder =
        !options.keep.empty() ? options.keep : scratch.emplace("adapter-test").path();
    int failed = 0;
    for (const Requirement& requirement : requirements) {
        const Finding finding = judge(requirement, candidate, folder);
        failed += finding.grade == Grade::failed;
        fmt::print("{}", for_stdout(fmt::format("{:<6}{:<36}{}\n", word(finding.grade),
                                                requirement.name, finding.text)));
        std::fflush(stdout);
    }
    if (failed > 0 && options.keep.empty())
        fmt::print("{}", for_stdout("The runs and their logs are gone: --keep DIR keeps them.\n"));
    fmt::print("{}", for_stdout(conclusion(failed) + "\n"));
    return static_cast<int>(failed == 0 ? ExitCode::done : ExitCode::tests_failed);
}

}  // namespace

CommandAction declare_adapter_test(CLI::App& app) {
    const auto options = std::make_shared<AdapterTestOptions>();
    app.add_option("--side", options->side, "the program under test; the partner is scripted")
        ->check(CLI::IsMember({"grains", "fluid"}))
        ->type_name("grains|fluid");
    app.add_option("--adapter", options->candidate.adapter,
                   "a shipped grains adapter, or openfoam or box, instead of a command")
        ->type_name("NAME");
    app.add_option("--dimension", options->candidate.dimension,
                   "of space: 2, with discs, or 3, with spheres")
        ->check(CLI::IsMember({2, 3}))
        ->type_name("2|3");
    app.add_option("--only", options->only, "the requirements whose name contains this")
        ->type_name("TEXT");
    app.add_option("--keep", options->keep, "keep the runs in this folder")->type_name("DIR");
    app.add_option("COMMAND", options->words,
                   "program and arguments, after --; the run folder is appended, for a fluid "
                   "-case RUN/fluid [-parallel]")
        ->type_name("");
    return [options] { return test_adapter(*options); };
}

}  // namespace turbidite
