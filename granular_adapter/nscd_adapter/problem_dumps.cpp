// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd_adapter/problem_dumps.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

#include "granular_adapter/nscd/problem/problem_file.hpp"

namespace turbidite {

ProblemDumps::ProblemDumps(const Settings& settings, std::filesystem::path run_folder)
    : folder_(std::move(run_folder) / "contacts") {
    if (!settings.has("contact.dump_interval")) return;
    const double windows = settings.real("contact.dump_interval") / settings.real("time.step");
    // An interval beyond any run means none; llround is undefined there.
    if (windows < 1e18) every_ = std::max<std::int64_t>(1, std::llround(windows));
}

void ProblemDumps::after(const Window& window, const nscd::ContactProblem& problem) const {
    // STEP of history.csv counts finished windows; window.index is 0 in the first.
    const std::int64_t step = window.index + 1;
    if (every_ == 0 || step % every_ != 0 || problem.contacts.empty()) return;
    const std::filesystem::path file = folder_ / ("problem_" + std::to_string(step) + ".dat");
    std::error_code reason;
    std::filesystem::create_directories(folder_, reason);
    std::ofstream stream(file);
    nscd::write_problem(stream, problem);
    if (!stream.flush())
        throw std::runtime_error("contact.dump_interval: " + file.string() +
                                 " cannot be written: check disk space and permissions");
}

}  // namespace turbidite
