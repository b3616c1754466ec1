// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Random changes of a case or a study: of the text of its files, as typing errors and damaged files
// are, and of its keys, as somebody who tries things out would set them.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace turbidite::mutation {

using Random = std::mt19937_64;

/// A case file with the files beside it, the arguments of --set, and a study of the case.
struct CaseText {
    std::string yaml, grains, walls;  ///< case.yaml, grains.csv, walls.csv
    std::vector<std::string> set;
    std::string study = {};  ///< study.yaml; empty: the case alone

    /// Everything, for a report.
    std::string all() const;
};

/// One to four changes of the text, of the keys, or of both.
CaseText mutated(CaseText text, Random& random);

}  // namespace turbidite::mutation
