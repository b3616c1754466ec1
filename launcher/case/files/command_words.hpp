// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The words of a command line in a case file (grains.command).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace turbidite {

/// Words are separated by spaces; single or double quotes keep spaces. Empty if a quote is not
/// closed or there is no word.
std::optional<std::vector<std::string>> command_words(const std::string& text);

/// The inverse of command_words.
std::string command_text(const std::vector<std::string>& words);

/// Words that name a file in `folder` get its absolute path, so that the command may be started
/// anywhere.
std::vector<std::string> with_absolute_files(std::vector<std::string> words,
                                             const std::filesystem::path& folder);

/// The file that a shell would start: `name` itself if it has a slash, otherwise the first
/// executable of that name in PATH; empty if there is none.
std::filesystem::path find_program_file(const std::string& name);

}  // namespace turbidite
