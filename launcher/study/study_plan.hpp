// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The runs of a study: every combination of the swept values of every part, each with its folder.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "launcher/case/case_file.hpp"
#include "launcher/study/study_file.hpp"

namespace turbidite {

struct PlannedRun {
    std::string part;
    std::string name;  ///< "compacity-0.785-seed-1", unique in its part
    std::filesystem::path case_file;
    std::vector<std::string> overrides;
    /// (swept key, value), "variant" among them; in the order of the axes.
    std::vector<std::pair<std::string, std::string>> values;
    std::string hash = {};                  ///< of the resolved case
    bool poured = false;                    ///< its grains are to be poured first
    std::string yaml = {};                  ///< the resolved case
    std::vector<std::string> given = {};    ///< keys that study, case file or command line name
    std::vector<std::string> remarks = {};  ///< warnings and notes of the case
    double seconds = 0.0;                   ///< predicted (case/run_cost.hpp)
    double disk = 0.0;                      ///< predicted [GB] (case/disk_cost.hpp)

    /// "column/compacity-0.785-seed-1": below the study's folder, and in messages.
    std::string path() const { return part + "/" + name; }
    ResolvedCase resolve() const { return load_case(case_file, overrides); }
};

/// In the order of the file; the last axis varies fastest. `overrides` go to every run, after its
/// own. Resolves every case and throws CaseRefused with the problems of the file and of all cases,
/// each told once. `quick` takes the keys of `quick` instead of those of `full`, and is refused for
/// a study that has none.
std::vector<PlannedRun> plan_study(const Study& study, const std::vector<std::string>& overrides,
                                   bool quick = false);

/// Of some runs, one after the other: "roughly 7 h, 52 GB of files".
std::string forecast_text(const std::vector<const PlannedRun*>& runs);

/// Warnings and notes of all runs, each told once, with the number of runs that it is of; what
/// differs in numbers alone is told of the first.
std::string remarks_text(const std::vector<PlannedRun>& plan);

/// Files of some runs, predicted [GB].
double predicted_disk(const std::vector<const PlannedRun*>& runs);

}  // namespace turbidite
