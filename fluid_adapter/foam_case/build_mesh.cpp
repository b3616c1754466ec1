// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Runs blockMesh and decomposePar as child processes. OpenFOAM finds its own settings through
// WM_PROJECT_DIR, which Debian does not set: /usr/share/openfoam unless the user sets another.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "coupler/protocol/failure.hpp"
#include "fluid_adapter/foam_case/fluid_case.hpp"

namespace turbidite {
namespace {

constexpr int not_started = 127;

[[noreturn]] void become(const char* program, const char* directory, const char* log) {
    const int file = ::open(log, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file >= 0) {
        ::dup2(file, STDOUT_FILENO);
        ::dup2(file, STDERR_FILENO);
    }
    ::execlp(program, program, "-case", directory, static_cast<char*>(nullptr));
    ::_exit(not_started);
}

int wait_for(pid_t child, const std::string& program) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0)
        if (errno != EINTR)
            throw Failure(ExitCode::participant_failed,
                          "waiting for " + program + ": " + std::strerror(errno));
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string last_words(const std::filesystem::path& log) {
    std::ifstream file(log);
    std::stringstream text;
    text << file.rdbuf();
    const std::string all = text.str();
    const std::size_t error = all.find("FOAM FATAL");
    const std::size_t from =
        error != std::string::npos ? error : all.size() - std::min<std::size_t>(all.size(), 500);
    return all.substr(from, 1000);
}

int run_utility(const std::string& program, const std::filesystem::path& directory,
                const std::filesystem::path& log) {
    ::setenv("WM_PROJECT_DIR", "/usr/share/openfoam", 0);
    const std::string where = directory.string(), into = log.string();
    const pid_t child = ::fork();
    if (child < 0)
        throw Failure(ExitCode::participant_failed,
                      "cannot start " + program + ": " + std::strerror(errno));
    if (child == 0) become(program.c_str(), where.c_str(), into.c_str());
    const int status = wait_for(child, program);
    if (status == not_started)
        throw Failure(ExitCode::participant_failed,
                      program +
                          " was not found: install the Debian package openfoam or put "
                          "OpenFOAM 1912's programs on PATH; spheres in space (dimension: 3) are "
                          "played without OpenFOAM by fluid.program: box");
    if (status != 0)
        throw Failure(ExitCode::participant_failed,
                      fmt::format("{} failed with code {} on {} (see {}):\n{}", program, status,
                                  where, into, last_words(log)));
    return 0;
}

}  // namespace

int build_fluid_mesh(const std::filesystem::path& directory, const std::filesystem::path& log) {
    return run_utility("blockMesh", directory, log);
}

int decompose_fluid_case(const std::filesystem::path& directory, const std::filesystem::path& log) {
    return run_utility("decomposePar", directory, log);
}

}  // namespace turbidite
