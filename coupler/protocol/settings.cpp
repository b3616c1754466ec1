// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/settings.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "coupler/protocol/number_text.hpp"

namespace turbidite {
namespace {

template <class Entries>
auto position(Entries& entries, const std::string& key) {
    return std::lower_bound(
        entries.begin(), entries.end(), key,
        [](const Settings::Entry& e, const std::string& k) { return e.first < k; });
}

template <class T>
T parse(const std::string& key, const std::string& value, const char* kind) {
    const std::optional<T> number = number_of<T>(value);
    if (!number) throw std::invalid_argument(key + " = \"" + value + "\" is not " + kind);
    return *number;
}

}  // namespace

void Settings::set(const std::string& key, const std::string& value) {
    const auto at = position(entries_, key);
    if (at != entries_.end() && at->first == key)
        at->second = value;
    else
        // Kept in order: entries() is sorted, and look-ups are binary.
        entries_.insert(at, {key, value});
}

void Settings::set(const std::string& key, double value) {
    char buffer[32];
    // The shortest text that is read back as the same double, to the last digit.
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
    set(key, std::string(buffer, end));
}

void Settings::set(const std::string& key, std::int64_t value) {
    set(key, std::to_string(value));
}

void Settings::set(const std::string& key, bool value) {
    set(key, std::string(value ? "true" : "false"));
}

bool Settings::has(const std::string& key) const {
    const auto at = position(entries_, key);
    return at != entries_.end() && at->first == key;
}

const std::string& Settings::text(const std::string& key) const {
    const auto at = position(entries_, key);
    if (at == entries_.end() || at->first != key)
        throw MissingKey("the resolved case has no key \"" + key + "\"");
    return at->second;
}

double Settings::real(const std::string& key) const {
    return parse<double>(key, text(key), "a number");
}

std::int64_t Settings::integer(const std::string& key) const {
    return parse<std::int64_t>(key, text(key), "a whole number");
}

bool Settings::flag(const std::string& key) const {
    const std::string& value = text(key);
    if (value != "true" && value != "false")
        throw std::invalid_argument(key + " = \"" + value + "\" is neither true nor false");
    return value == "true";
}

}  // namespace turbidite
