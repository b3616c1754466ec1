// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/site.hpp"

#include <fmt/format.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "coupler/protocol/failure.hpp"
#include "launcher/job/launch_line.hpp"

namespace turbidite::bench {

namespace fs = std::filesystem;

Site::Site(bool quick) : quick_(quick), programs_(find_programs()), folder_("bench") {
    // OpenFOAM reads its settings while its libraries are loaded.
    ::setenv("WM_PROJECT_DIR", "/usr/share/openfoam", 0);
}

fs::path Site::source(const std::string& file) const {
    return programs_.source / "bench" / file;
}

void Site::run(const std::vector<std::string>& line, const std::string& log) const {
    const std::string command =
        shell_line(line) + " >" + shell_line({(folder() / log).string()}) + " 2>&1 </dev/null";
    std::fflush(nullptr);
    const int status = std::system(command.c_str());
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
    const std::string said = text(log);
    throw Failure(ExitCode::tests_failed,
                  fmt::format("{} failed with status {}; the end of its output:\n{}", line.front(),
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
