// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a program must do, one requirement after the other, each with a verdict in words.
#pragma once

#include <string>
#include <vector>

#include "launcher/adapter_test/verdicts.hpp"

namespace turbidite {

struct Requirement {
    const char* name;
    Finding (*judge)(const Candidate& candidate, const std::filesystem::path& folder);
    bool optional;  ///< the program may refuse the case
};

const std::vector<Requirement>& grains_requirements();
const std::vector<Requirement>& fluid_requirements();

}  // namespace turbidite
