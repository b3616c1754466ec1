// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/keys/key_value.hpp"

#include <fmt/format.h>

#include <cctype>
#include <stdexcept>

#include "coupler/protocol/number_text.hpp"

namespace turbidite {
namespace {

template <class T>
std::optional<T> parse_number(const std::string& text) {
    // In a case a plus sign may stand before it.
    return number_of<T>(text.rfind('+', 0) == 0 ? text.substr(1) : text);
}

// YAML writes `.nan`, `.inf`, `-.inf`.
std::string without_yaml_point(std::string text) {
    for (std::size_t i = 0; i + 1 < text.size() && i < 2; ++i)
        if (text[i] == '.' && std::isalpha(static_cast<unsigned char>(text[i + 1])))
            return text.erase(i, 1);
    return text;
}

}  // namespace

std::optional<double> parse_real(const std::string& text) {
    return parse_number<double>(without_yaml_point(text));
}

std::optional<std::int64_t> parse_integer(const std::string& text) {
    return parse_number<std::int64_t>(text);
}

std::optional<bool> parse_flag(const std::string& text) {
    for (const char* yes : {"true", "True", "yes", "on"})
        if (text == yes) return true;
    for (const char* no : {"false", "False", "no", "off"})
        if (text == no) return false;
    return std::nullopt;
}

std::string real_text(double value) {
    return fmt::format("{}", value);
}

std::string list_text(const std::vector<double>& values) {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : ", ") + real_text(value);
    return "[" + text + "]";
}

std::vector<double> real_list(const std::string& key, const std::string& text) {
    std::vector<double> values;
    std::string field;
    for (const char c : text) {
        if (c == ',' || c == ']') {
            const auto value = parse_real(field);
            if (!value)
                throw std::invalid_argument(key + " = \"" + text + "\" is not a list of numbers");
            values.push_back(*value);
            field.clear();
        } else if (c != '[' && c != ' ') {
            field += c;
        }
    }
    return values;
}

}  // namespace turbidite
