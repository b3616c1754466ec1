// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A short run of a grains adapter against a scripted fluid (coupler/participant/scripted.hpp),
// whose motion is known in closed form.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coupler/protocol/settings.hpp"
#include "launcher/job/job_outcome.hpp"

namespace turbidite {

/// The adapter under test: one of the shipped ones by its name, or a command.
struct Candidate {
    std::string adapter = "external";
    std::string command;
};

/// Grains and changes of the case that all trials share: discs of ratio 1.5 in a box of 16 x 10 D.
struct TrialCase {
    std::string name;                    ///< of its folder
    std::string grains;                  ///< CSV: id,x,y[,vx…]
    std::vector<std::string> overrides;  ///< key=value
    bool stop_at_once = false;           ///< a stop request is there before the first window
};

struct Trial {
    JobOutcome outcome;
    std::map<std::string, std::vector<double>> history;  ///< by column; empty cells are NaN
    double grain_balance = 0.0;                          ///< largest
    Settings settings;

    bool done() const { return outcome.code == ExitCode::done; }
    double last(const std::string& column) const;
};

/// Plays it in `folder`/NAME; all output goes to files there. Throws Failure (bad input) when the
/// adapter refuses the case before anything starts.
Trial play_trial(const Candidate& candidate, const TrialCase& trial,
                 const std::filesystem::path& folder);

/// Goes on with a trial that has been played, as `turbidite resume --set CHANGES`; empty if it has
/// no checkpoint.
std::optional<Trial> resume_trial(const TrialCase& trial, const std::vector<std::string>& changes,
                                  const std::filesystem::path& folder);

}  // namespace turbidite
