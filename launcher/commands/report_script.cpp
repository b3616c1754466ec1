// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/commands/report_script.hpp"
#include "launcher/job/terminal.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace turbidite {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void note_interrupt(int) {
    interrupted = 1;
}

/// Ctrl-C while a script works goes to this program alone, since a script begins with SIGINT
/// ignored: Python would answer with a traceback.
class InterruptsNoted {
 public:
    InterruptsNoted() : before_(std::signal(SIGINT, SIG_IGN)) { interrupted = 0; }
    ~InterruptsNoted() { std::signal(SIGINT, before_); }
    InterruptsNoted(const InterruptsNoted&) = delete;
    InterruptsNoted& operator=(const InterruptsNoted&) = delete;

    /// Once the script has begun; not by std::signal, which would let waitpid go on.
    void begin() const {
        struct sigaction action = {};
        action.sa_handler = note_interrupt;
        ::sigaction(SIGINT, &action, nullptr);
    }

 private:
    void (*before_)(int);
};

/// A study does not go on with its next run, nor a shell with its next command.
[[noreturn]] void end_by_interrupt(const std::string& remedy) {
    print_on_stderr(fmt::format("\nStopped. {}\n", remedy));
    std::signal(SIGINT, SIG_DFL);
    std::raise(SIGINT);
    std::_Exit(static_cast<int>(ExitCode::interrupted));
}

/// Exit status of a script; -1 when it did not end by itself. Ctrl-C ends the script and this
/// program; `remedy` then says how to get what it was to write.
int run_script(const Programs& programs, const std::filesystem::path& script,
               const std::vector<std::string>& arguments, const std::string& remedy) {
    // -B: no __pycache__ in the source tree.
    std::vector<std::string> line{programs.python(), "-B", script};
    line.insert(line.end(), arguments.begin(), arguments.end());
    std::vector<char*> words;
    for (std::string& word : line) words.push_back(word.data());
    words.push_back(nullptr);
    std::fflush(nullptr);
    pid_t child = 0;
    const InterruptsNoted noted;
    if (::posix_spawnp(&child, words.front(), nullptr, nullptr, words.data(), environ) != 0)
        return -1;
    noted.begin();
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR)
        if (interrupted != 0) ::kill(child, SIGTERM);
    if (interrupted != 0) end_by_interrupt(remedy);
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

bool report_wanted() {
    const char* wish = std::getenv("TURBIDITE_REPORT");
    return wish == nullptr || std::string(wish) != "off";
}

bool write_report(const RunFolder& folder, const Programs& programs) {
    return run_script(programs, programs.report(), {folder.root},
                      fmt::format("turbidite report {} draws the report of this run.",
                                  folder.root.string())) == 0;
}

ExitCode write_film(const RunFolder& folder, const Programs& programs) {
    return outcome_of(
        run_script(programs, programs.film(), {folder.root}, "There is no film so far."));
}

ExitCode write_study_results(const std::filesystem::path& folder, const Programs& programs) {
    return outcome_of(run_script(programs, programs.study(), {folder},
                                 "The same line again writes table and figures."));
}

ExitCode write_comparison(const std::filesystem::path& page, const std::vector<RunFolder>& runs,
                          bool each, const Programs& programs) {
    std::vector<std::string> arguments;
    if (each) arguments.push_back("--each");
    arguments.push_back(page);
    for (const RunFolder& run : runs) arguments.push_back(run.root);
    return outcome_of(run_script(programs, programs.compare(), arguments, "Nothing was compared."));
}

}  // namespace turbidite
