// SPDX-License-Identifier: LGPL-2.1-or-later
//
// contact.dump_interval: writes contact problems of a run to RUN/contacts/problem_STEP.dat
// (nscd/problem/problem_file.hpp), with STEP as in history.csv. Steps without contacts write
// no file.
//
// Reads: contact.dump_interval, time.step (both in t_c).
#pragma once

#include <cstdint>
#include <filesystem>

#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"
#include "granular_adapter/nscd/problem/contact_problem.hpp"

namespace turbidite {

class ProblemDumps {
 public:
    /// No dumps.
    ProblemDumps() = default;
    /// No dumps unless the case has contact.dump_interval.
    ProblemDumps(const Settings& settings, std::filesystem::path run_folder);

    /// Writes the problem if a dump is due. Throws std::runtime_error naming a file that cannot be
    /// written.
    void after(const Window& window, const nscd::ContactProblem& problem) const;

 private:
    std::int64_t every_ = 0;  ///< interval in windows; 0: never
    std::filesystem::path folder_;
};

}  // namespace turbidite
