// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Verdicts on trials, and those that are the same for grains and fluid.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupler/protocol/message.hpp"
#include "launcher/adapter_test/trial.hpp"

namespace turbidite {

enum class Grade { met, failed, not_supported };

struct Finding {
    Grade grade = Grade::met;
    std::string text;  ///< what was measured, or why it failed
};

inline constexpr double round_off = 1e-9;
inline constexpr double deepest_overlap = 0.05;  ///< that grains may come to [D]

/// The trial ended where it should not.
Finding failure_of(const JobOutcome& outcome);

/// What the program said when it refused the case of a trial before the first window, as one does
/// that does not support it; empty if it ran, crashed, left, or called exit.
std::optional<std::string> refusal_of(const Trial& trial);

/// "velocity differs by 1e-12, allowed 1e-9".
Finding within(double error, double limit, const std::string& what);

/// Largest difference of two columns; infinite if one is longer or holds what is no number.
double worst(const std::vector<double>& column, const std::vector<double>& expected);

/// Largest difference of these columns between two trials.
double worst(const Trial& a, const Trial& b, const std::vector<const char*>& columns);

/// Ends with code 143 when a stop request is there from the beginning.
Finding ends_on_request(const Candidate& candidate, TrialCase trial,
                        const std::filesystem::path& folder);

struct OnTwoRanks {
    Finding finding;
    Trial shared;  ///< the run on two ranks
};

/// A run on one rank and one with these keys on two have the same motion, or two are refused.
OnTwoRanks moves_alike(const Candidate& candidate, TrialCase trial,
                       const std::vector<std::string>& keys_of_two, double tolerance,
                       const std::filesystem::path& folder);

/// Two equal runs, NAME and NAME-again, have the same history, to the last digit.
Finding runs_alike(const Candidate& candidate, TrialCase trial,
                   const std::filesystem::path& folder);

/// A run until 0.45 t_c that goes on until 1 t_c, NAME-parts, has the history of NAME in one part,
/// to the last digit.
Finding goes_on_alike(const Candidate& candidate, TrialCase trial,
                      const std::filesystem::path& folder);

/// The program refuses a window of the trial in which the coupler's message of this kind is left
/// out, and one in which it comes twice.
Finding refuses_disorder(const Candidate& candidate, const TrialCase& trial, Kind kind,
                         const std::filesystem::path& folder);

}  // namespace turbidite
