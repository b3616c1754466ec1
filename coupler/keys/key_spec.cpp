// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/keys/key_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace turbidite {
namespace {

std::string bound(const char* open, const char* closed, bool is_open, double value) {
    return fmt::format("{} {}", is_open ? open : closed, value);
}

std::string range_text(const KeySpec& key) {
    const Range& range = key.range;
    std::string text = type_name(key.type);
    if (range.lower == range.upper) return fmt::format("{}", range.lower);
    if (std::isfinite(range.lower)) text += bound(" above", " from", range.lower_open, range.lower);
    if (std::isfinite(range.upper))
        text += bound(" below", " up to", range.upper_open, range.upper);
    else if (std::isfinite(range.lower) && !range.lower_open)
        text += " on";
    return text;
}

std::string choice_names(const KeySpec& key) {
    std::string text;
    for (const Choice& choice : key.choices)
        if (choice.available) text += (text.empty() ? "" : ", ") + choice.name;
    return text;
}

bool is_word(const std::string& text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return std::isalnum(c) || c == '_';
    });
}

/// NAME stands for a word, FIRST-SECOND for two.
bool stands_for(const std::string& part, const std::string& text) {
    if (part == "NAME") return is_word(text);
    if (part != "FIRST-SECOND") return part == text;
    const auto dash = text.find('-');
    return dash != std::string::npos && is_word(text.substr(0, dash)) &&
           is_word(text.substr(dash + 1));
}

/// Placeholders are the only capitals in the name of a key.
bool has_placeholder(const std::string& name) {
    return std::any_of(name.begin(), name.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
}

bool means(const KeySpec& key, const std::string& name) {
    if (key.name == name) return true;
    if (!has_placeholder(key.name)) return false;
    const auto parts = parts_of(key.name), words = parts_of(name);
    return std::equal(parts.begin(), parts.end(), words.begin(), words.end(), stands_for);
}

}  // namespace

std::vector<std::string> parts_of(const std::string& name) {
    std::vector<std::string> parts(1);
    for (const char c : name)
        if (c == '.')
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

std::string with_words_of(const std::string& written, const std::string& name) {
    std::vector<std::string> parts = parts_of(name);
    const std::vector<std::string> words = parts_of(written);
    if (parts.size() != words.size()) return name;
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (has_placeholder(parts[i]) && stands_for(parts[i], words[i])) parts[i] = words[i];
    return fmt::format("{}", fmt::join(parts, "."));
}

KeySpec of_space(KeySpec key) {
    key.dimension = 3;
    if (key.need == Need::fallback) key.in_space.fallback = std::exchange(key.fallback, "");
    key.need = Need::conditional;
    key.when = "dimension: 3";
    // Never asked for: in space its default is filled in, if it has one (key_check.cpp).
    key.required = [](const Settings&) { return false; };
    return key;
}

KeySpec in_dimension(const KeySpec& key, int dimension) {
    KeySpec result = key;
    if (dimension != 3) return result;
    const InSpace& space = key.in_space;
    if (space.entries > 0) result.entries = space.entries;
    if (!space.allowed.empty()) result.allowed = space.allowed;
    if (!space.remedy.empty()) result.remedy = space.remedy;
    if (space.fallback) result.fallback = *space.fallback;
    return result;
}

bool Range::contains(double value) const {
    const bool above = lower_open ? value > lower : value >= lower;
    const bool below = upper_open ? value < upper : value <= upper;
    return above && below;
}

const KeySpec* find_key(const KeyTable& table, const std::string& name) {
    const auto at = std::find_if(table.begin(), table.end(),
                                 [&](const KeySpec& key) { return means(key, name); });
    return at == table.end() ? nullptr : &*at;
}

bool has_words(const KeySpec& key) {
    return key.name.find(".NAME.") != std::string::npos ||
           key.name.find(".FIRST-SECOND.") != std::string::npos;
}

bool is(const Settings& settings, const char* key, const char* value) {
    return settings.has(key) && settings.text(key) == value;
}

bool in_space(const Settings& settings) {
    return is(settings, "dimension", "3");
}

std::string allowed_values(const KeySpec& key) {
    if (!key.allowed.empty()) return key.allowed;
    if (key.type == KeyType::choice) return "Available: " + choice_names(key) + ".";
    if (key.type == KeyType::flag) return "Either true or false.";
    return fmt::format("It must be {}{}{}.", range_text(key), key.unit.empty() ? "" : ", in ",
                       key.unit);
}

std::string type_name(KeyType type) {
    switch (type) {
        case KeyType::text:
            return "a text";
        case KeyType::choice:
            return "a choice";
        case KeyType::real:
            return "a number";
        case KeyType::integer:
            return "a whole number";
        case KeyType::flag:
            return "true or false";
        case KeyType::real_list:
            return "a list of numbers";
    }
    return "";
}

std::string group_of(const std::string& key) {
    const auto point = key.find('.');
    return point == std::string::npos ? "" : key.substr(0, point);
}

}  // namespace turbidite
