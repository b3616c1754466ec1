// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The cases and studies that come with the program, by name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "launcher/job/programs.hpp"

namespace turbidite {

/// In alphabetical order, without .yaml.
std::vector<std::string> shipped_cases(const Programs& programs);

/// What a word of the command line means: a file, or a shipped case by its name, with or without
/// `configs/` in front and `.yaml` at the end. Throws Failure (bad input) for a plain word that is
/// neither; a path without a file is left to those who read it.
std::filesystem::path case_named(const std::string& word, const Programs& programs);

}  // namespace turbidite
