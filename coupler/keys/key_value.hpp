// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Converts text of a case file to values and back. Nothing is guessed: `1,5` and `60 grains` are
// not numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace turbidite {

/// Also returns nan and inf (written `.nan`, `.inf` in YAML); the caller decides what it accepts.
std::optional<double> parse_real(const std::string& text);
std::optional<std::int64_t> parse_integer(const std::string& text);
std::optional<bool> parse_flag(const std::string& text);

/// Shortest text that reads back as the same number.
std::string real_text(double value);

/// Text of a list of numbers in the resolved case: "[25, 50]".
std::string list_text(const std::vector<double>& values);

/// The inverse; throws std::invalid_argument naming the key.
std::vector<double> real_list(const std::string& key, const std::string& text);

}  // namespace turbidite
