// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a grains adapter must do, one requirement after the other, each with a verdict in words.
#pragma once

#include <string>
#include <vector>

#include "launcher/adapter_test/trial.hpp"

namespace turbidite {

enum class Grade { met, failed, not_supported };

struct Finding {
    Grade grade = Grade::met;
    std::string text;  ///< what was measured, or why it failed
};

struct Requirement {
    const char* name;
    Finding (*judge)(const Candidate& candidate, const std::filesystem::path& folder);
    bool optional;  ///< the adapter may refuse the case
};

const std::vector<Requirement>& requirements();

}  // namespace turbidite
