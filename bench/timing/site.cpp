// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/timing/site.hpp"

#include <fmt/format.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>

#include "coupler/protocol/failure.hpp"
#include "launcher/job/launch_line.hpp"

namespace turbidite::bench {

namespace fs = std::filesystem;

namespace {

/// For a shell.
std::string into_log(const std::vector<std::string>& line, const fs::path& log) {
    return shell_line(line) + " >" + shell_line({log.string()}) + " 2>&1 </dev/null";
}

/// The program ended for Ctrl-C or SIGTERM, or its shell says so.
bool was_interrupted(int status) {
    if (WIFSIGNALED(status)) return WTERMSIG(status) == SIGINT || WTERMSIG(status) == SIGTERM;
    return WEXITSTATUS(status) == 128 + SIGINT || WEXITSTATUS(status) == 128 + SIGTERM;
}

}  // namespace

Site::Site(bool quick) : quick_(quick), programs_(find_programs()), folder_("bench") {
    // OpenFOAM reads its settings while its libraries are loaded.
    ::setenv("WM_PROJECT_DIR", "/usr/share/openfoam", 0);
}

fs::path Site::source(const std::string& file) const {
    return programs_.source / "bench" / file;
}

void Site::run(const std::vector<std::string>& line, const std::string& log) const {
    std::fflush(nullptr);
    const int status = std::system(into_log(line, folder() / log).c_str());
    // system() ignores Ctrl-C: it is meant for all of this.
    if (was_interrupted(status))
        throw Failure(ExitCode::interrupted, "interrupted; nothing more is measured");
    demand_success(line.front(), status, log);
}

double Site::peak_memory_of(const std::vector<std::string>& line, const std::string& log) const {
    const std::string command = "exec " + into_log(line, folder() / log);
    std::fflush(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        ::_exit(127);
    }
    int status = 0;
    rusage usage{};
    if (child < 0 || ::wait4(child, &status, 0, &usage) != child)
        throw Failure(ExitCode::tests_failed, line.front() + " cannot be started");
    demand_success(line.front(), status, log);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

void Site::demand_success(const std::string& program, int status, const std::string& log) const {
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
    const std::string said = text(log);
    throw Failure(ExitCode::tests_failed,
                  fmt::format("{} failed with status {}; the end of its output:\n{}", program,
                              WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
                              said.substr(said.size() - std::min<std::size_t>(said.size(), 600))));
}

std::string Site::text(const std::string& log) const {
    std::ifstream file(folder() / log);
    return {std::istreambuf_iterator<char>(file), {}};
}

Duel alternate(int repeats, const Contender& first, const Contender& second) {
    Duel duel;
    for (int i = 0; i < repeats; ++i) {
        duel.first.push_back(first());
        duel.second.push_back(second());
    }
    return duel;
}

double median_of(const std::vector<Sample>& samples, const Quantity& quantity) {
    std::vector<double> values;
    for (const Sample& sample : samples) values.push_back(quantity(sample));
    return median(values);
}

Measured ratio(const Duel& duel, const Quantity& quantity) {
    std::vector<double> each;
    for (std::size_t i = 0; i < duel.first.size(); ++i)
        each.push_back(quantity(duel.first[i]) / quantity(duel.second[i]));
    const auto [lowest, highest] = std::minmax_element(each.begin(), each.end());
    return {
        median_of(duel.first, quantity) / median_of(duel.second, quantity), *lowest, *highest, {}};
}

}  // namespace turbidite::bench
