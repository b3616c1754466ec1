// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite COMMAND: the commands are a table, one file command_*.cpp each.
#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "coupler/keys/nearest_name.hpp"
#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/files/freed_memory.hpp"
#include "launcher/case/keys/wrapped_text.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/job/terminal.hpp"
#include "launcher/version.hpp"

namespace turbidite {
namespace {

constexpr auto description =
    "Turbidite: immersed granular flows, OpenFOAM and YADE coupled by a distributed-multiplier "
    "fictitious-domain method.";

constexpr auto footer =
    "Exit codes: 0 done, 1 a test or benchmark failed, 2 bad usage or case, 3 handshake refused, "
    "4 a program of the job failed, 5 stalled, 6 physics refused (NaN, overlap, grain through a "
    "wall), 130/143 interrupted (`turbidite resume` goes on).";

const std::vector<Command>& commands() {
    static const std::vector<Command> table = {
        {"run", "run a case: validate, prepare a folder, start the job, write report.html",
         declare_run},
        {"new", "write a case of your own, beginning with a shipped one", declare_new},
        {"resume", "go on with a run from its last whole checkpoint", declare_resume},
        {"check", "validate a case or a study, all errors at once", declare_check},
        {"report", "write report.html of a run folder", declare_report},
        {"compare", "compare several runs on one page, with their differences in numbers",
         declare_compare},
        {"study", "run what is missing of a sweep of cases, then its table and figures",
         declare_study},
        {"gallery", "play shipped cases and compare with the numbers expected of them",
         declare_gallery},
        {"adapter-test", "play a scripted partner against a grains adapter, and say what conforms",
         declare_adapter_test},
        {"replay", "play a recorded run again with one of its programs alone, and compare",
         declare_replay},
        {"keys", "print every key of a case file with unit, default and range", declare_keys},
        {"docs", "show the pages in a browser, with a search, without internet", declare_docs},
        {"doctor", "say what is installed and built, what is missing, and play a short job",
         declare_doctor},
        {"test", "run the tests", declare_test},
        {"bench", "compare the speed of this software with others", declare_bench},
        {"yade", "run your own YADE script with the contact engine", declare_yade},
    };
    return table;
}

/// CLI11 does not break long lines.
class Help final : public CLI::Formatter {
    std::string make_help(const CLI::App* app, std::string name,
                          CLI::AppFormatMode mode) const override {
        return fitted(CLI::Formatter::make_help(app, std::move(name), mode), terminal_width());
    }
};

std::string version_line() {
    const std::string name = "turbidite " + version();
    return commit().empty() ? name : name + " (commit " + commit() + ")";
}

int end_with(ExitCode code, const std::string& text) {
    std::fflush(stdout);
    tell_on_stderr(text);
    return static_cast<int>(code);
}

int act(const CommandAction& action) {
    try {
        return action();
    } catch (const Failure& failure) {
        std::fflush(stdout);
        print_on_stderr(for_stderr(std::string(failure.what()) + "\n"));
        return static_cast<int>(failure.code());
    } catch (const std::filesystem::filesystem_error& error) {
        const bool full = error.code() == std::errc::no_space_on_device;
        const ExitCode code = full ? ExitCode::participant_failed : ExitCode::bad_input;
        return end_with(
            code, fmt::format("{}: {}\n  {} Exit code {}.", error.path1().string(),
                              error.code().message(),
                              full ? "Make room: df -h."
                                   : "Check this path, and what you may read and write there.",
                              static_cast<int>(code)));
    } catch (const std::bad_alloc&) {
        return end_with(ExitCode::bad_input,
                        "not enough memory\n  Ask for fewer grains or cells; `free -g` shows what "
                        "there is. Exit code 2.");
    } catch (const std::exception& error) {
        return end_with(ExitCode::participant_failed, error.what());
    }
}

/// Empty if the first word is a command or an option.
std::string unknown_command(const std::string& word) {
    if (word.empty() || word[0] == '-') return "";
    std::vector<std::string> names;
    for (const Command& command : commands()) names.push_back(command.name);
    if (std::find(names.begin(), names.end(), word) != names.end()) return "";
    const std::string all = fmt::format("The commands are {}.", fmt::join(names, ", "));
    return fmt::format("turbidite: there is no command \"{}\"\n  {}", word,
                       did_you_mean(word, names, all));
}

/// Complains about the first option that the command does not have; empty if all are known.
std::string unknown_option(const CLI::App& app, const std::vector<std::string>& words) {
    const auto found =
        app.get_subcommands([&](const CLI::App* one) { return one->check_name(words[0]); });
    if (found.empty()) return "";
    std::vector<std::string> known;
    for (const CLI::Option* option : found.front()->get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    for (std::size_t i = 1; i < words.size() && words[i] != "--"; ++i) {
        const std::string name = words[i].substr(0, words[i].find('='));
        if (!name.starts_with("--") || std::find(known.begin(), known.end(), name) != known.end())
            continue;
        const std::string all = fmt::format("turbidite {} --help lists the options.", words[0]);
        return fmt::format("turbidite {}: there is no option {}\n  {}", words[0], name,
                           did_you_mean(name, known, all));
    }
    return "";
}

/// `turbidite help run` is `turbidite run --help`; without a command the help is shown.
std::vector<std::string> words_of(int argc, char** argv) {
    std::vector<std::string> words(argv + 1, argv + argc);
    if (words.empty()) return {"--help"};
    if (words[0] != "help") return words;
    words.erase(words.begin());
    words.push_back("--help");
    return words;
}

/// A file that is opened later must not become a standard stream that was closed
/// (`turbidite run CASE 2>&-`): what is said would go into it.
void open_standard_streams() {
    for (int stream = open("/dev/null", O_RDWR); stream >= 0; stream = open("/dev/null", O_RDWR)) {
        if (stream <= STDERR_FILENO) continue;
        close(stream);
        return;
    }
}

bool all_was_written() {
    if (stdout_took_all()) return true;
    tell_on_stderr("what this command has printed could not be written to standard output");
    return false;
}

int turbidite_main(const std::vector<std::string>& words) {
    if (const std::string complaint = unknown_command(words[0]); !complaint.empty()) {
        print_on_stderr(for_stderr(complaint + "\n"));
        return static_cast<int>(ExitCode::bad_input);
    }
    CLI::App app{description, "turbidite"};
    app.set_version_flag("--version", [] { return version_line(); });
    app.require_subcommand(1);
    app.formatter(std::make_shared<Help>());
    app.footer(footer);
    CommandAction action;
    for (const Command& command : commands()) {
        CLI::App* options = app.add_subcommand(command.name, command.help);
        options->callback([&action, run = command.declare(*options)] { action = run; });
    }
    try {
        std::vector<std::string> from_the_end(words.rbegin(), words.rend());  // as CLI11 takes them
        app.parse(from_the_end);
    } catch (const CLI::ExtrasError& error) {
        // CLI11 names all words behind the one that it does not know.
        if (const std::string complaint = unknown_option(app, words); !complaint.empty())
            print_on_stderr(for_stderr(complaint + "\n"));
        else
            app.exit(error);
        return static_cast<int>(ExitCode::bad_input);
    } catch (const CLI::ParseError& error) {
        const bool asked_for = error.get_exit_code() == 0;  // --help, --version
        app.exit(error);
        return static_cast<int>(asked_for ? ExitCode::done : ExitCode::bad_input);
    }
    return act(action);
}

}  // namespace
}  // namespace turbidite

int main(int argc, char** argv) {
    turbidite::open_standard_streams();
    turbidite::ask_for_large_pages();
    const int code = turbidite::turbidite_main(turbidite::words_of(argc, argv));
    if (!turbidite::all_was_written())
        return static_cast<int>(turbidite::ExitCode::participant_failed);
    return argc == 1 ? static_cast<int>(turbidite::ExitCode::bad_input) : code;
}
