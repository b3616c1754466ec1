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
    std::string hash = {};  ///< of the resolved case

    /// "column/compacity-0.785-seed-1": below the study's folder, and in messages.
    std::string path() const { return part + "/" + name; }
    ResolvedCase resolve() const { return load_case(case_file, overrides); }
};

/// In the order of the file; the last axis varies fastest. `overrides` go to every run, after its
/// own. Resolves every case and throws CaseRefused with the problems of all of them, each told
/// once.
std::vector<PlannedRun> plan_study(const Study& study, const std::vector<std::string>& overrides);

}  // namespace turbidite
