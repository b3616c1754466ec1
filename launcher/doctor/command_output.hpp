// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a short command of the machine prints.
#pragma once

#include <string>
#include <vector>

namespace turbidite {

struct CommandOutput {
    int code = 0;      ///< 127: there is no such program; 124: it was ended after 30 s
    std::string text;  ///< stdout and stderr
};

CommandOutput output_of(const std::vector<std::string>& line);

/// The text behind `start`, up to a space, a bracket or the end of the line; empty without `start`.
std::string word_after(const std::string& start, const std::string& text);

/// The first line that is neither empty nor a heading or rule of dashes, without indentation.
std::string first_words(const std::string& text);

}  // namespace turbidite
