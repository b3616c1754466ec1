// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A short run of one program against a scripted partner (launcher/turbidite_partner.cpp), whose
// motion is known in closed form.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coupler/protocol/hello.hpp"
#include "coupler/protocol/settings.hpp"
#include "launcher/job/job_outcome.hpp"

namespace turbidite {

/// The program under test: a shipped one, or a command.
struct Candidate {
    Role side = Role::grains;
    std::string adapter = users_program;  ///< a shipped one by its name
    std::vector<std::string> words = {};  ///< program and arguments; empty: the shipped one
    int dimension = 2;                    ///< of space: discs or spheres
};

/// Grains and changes of the case that all trials of a side share (trial.cpp): discs of ratio 1.5,
/// spheres of ratio 2.5.
struct TrialCase {
    std::string name;    ///< of its folder
    std::string grains;  ///< CSV: id,x,y[,vx…]; in space in the middle of the depth
    std::vector<std::string> overrides;  ///< key=value
    bool stop_at_once = false;           ///< a stop request is there before the first window
};

struct Trial {
    JobOutcome outcome;
    std::map<std::string, std::vector<double>> history;  ///< by column; empty cells are NaN
    std::map<std::string, double> maxima;                ///< of run.json
    Settings settings;
    std::filesystem::path root;       ///< its run folder
    std::filesystem::path recording;  ///< of the program under test

    bool done() const { return outcome.code == ExitCode::done; }
    double last(const std::string& column) const;
    double maximum(const std::string& of) const;
};

/// Plays it in `folder`/NAME; all output goes to files there. Where another requirement has played
/// the same case under this name, that run is the trial. Throws Failure (bad input) when the case
/// does not suit the adapter, before anything starts.
Trial play_trial(const Candidate& candidate, const TrialCase& trial,
                 const std::filesystem::path& folder);

/// Goes on with a trial that has been played, as `turbidite resume --set CHANGES`; empty if it has
/// no checkpoint.
std::optional<Trial> resume_trial(const Candidate& candidate, const TrialCase& trial,
                                  const std::vector<std::string>& changes,
                                  const std::filesystem::path& folder);

/// Plays a recording of it to the candidate, as `turbidite replay` does, in `folder`/NAME/AS.
JobOutcome replay_trial(const Candidate& candidate, const TrialCase& trial, const std::string& as,
                        const std::filesystem::path& recording,
                        const std::filesystem::path& folder);

}  // namespace turbidite
