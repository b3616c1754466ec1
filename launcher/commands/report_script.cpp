// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/commands/report_script.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

namespace turbidite {
namespace {

/// Exit status of a script; -1 when it did not end by itself. A signal to stop ends this program
/// too: std::system would ignore it, and a study would go on with its next run.
int run_script(const Programs& programs, const std::filesystem::path& script,
               const std::vector<std::string>& arguments) {
    // -B: no __pycache__ in the source tree.
    std::vector<std::string> line{programs.python(), "-B", script};
    line.insert(line.end(), arguments.begin(), arguments.end());
    std::vector<char*> words;
    for (std::string& word : line) words.push_back(word.data());
    words.push_back(nullptr);
    std::fflush(nullptr);
    pid_t child = 0;
    if (::posix_spawnp(&child, words.front(), nullptr, nullptr, words.data(), environ) != 0)
        return -1;
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// What a script says with its exit status; anything unforeseen is a failure.
ExitCode outcome_of(int status) {
    for (const ExitCode code : {ExitCode::done, ExitCode::bad_input})
        if (status == static_cast<int>(code)) return code;
    return ExitCode::participant_failed;
}

}  // namespace

void require_run_folder(const std::filesystem::path& directory) {
    if (std::filesystem::exists(RunFolder{directory}.resolved_case())) return;
    throw Failure(ExitCode::bad_input,
                  fmt::format("{} is not a run folder: it has no case.yaml\n  Give a folder "
                              "written by `turbidite run`. Exit code 2.",
                              directory.string()));
}

bool write_report(const RunFolder& folder, const Programs& programs) {
    return run_script(programs, programs.report(), {folder.root}) == 0;
}

ExitCode write_film(const RunFolder& folder, const Programs& programs) {
    return outcome_of(run_script(programs, programs.film(), {folder.root}));
}

bool write_study_results(const std::filesystem::path& folder, const Programs& programs) {
    return run_script(programs, programs.study(), {folder}) == 0;
}

ExitCode write_comparison(const std::filesystem::path& page, const std::vector<RunFolder>& runs,
                          bool each, const Programs& programs) {
    std::vector<std::string> arguments;
    if (each) arguments.push_back("--each");
    arguments.push_back(page);
    for (const RunFolder& run : runs) arguments.push_back(run.root);
    return outcome_of(run_script(programs, programs.compare(), arguments));
}

}  // namespace turbidite
