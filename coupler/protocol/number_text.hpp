// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Numbers in texts of the resolved case. They are read alike whatever locale a host has set, in
/// which strtod may expect a comma. Valid C++17.
#pragma once

#include <charconv>
#include <istream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace turbidite {

/// The whole text must be the number: "0.5x" is none.
template <class T>
std::optional<T> number_of(const std::string& text) {
    T result{};
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, result);
    if (error != std::errc() || stop != end) return std::nullopt;
    return result;
}

/// The words that are left, all of which must be numbers. Throws std::invalid_argument with the
/// first that is none: "has no number \"x\"".
inline std::vector<double> remaining_numbers(std::istream& words) {
    std::vector<double> numbers;
    for (std::string word; words >> word;) {
        const auto number = number_of<double>(word);
        if (!number) throw std::invalid_argument("has no number \"" + word + "\"");
        numbers.push_back(*number);
    }
    return numbers;
}

}  // namespace turbidite
