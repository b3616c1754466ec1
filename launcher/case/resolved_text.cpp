// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/resolved_text.hpp"

#include <fmt/format.h>

#include "coupler/protocol/case_hash.hpp"
#include "launcher/case/keys/keys.hpp"

namespace turbidite {
namespace {

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + "\"";
}

std::string value_text(const KeySpec& key, const std::string& name, const Settings& settings) {
    if (!settings.has(name)) return "~";
    const std::string& value = settings.text(name);
    return key.type == KeyType::text ? quoted(value) : value;
}

std::string line_of(const KeySpec& key, const std::string& full_name, const Settings& settings) {
    const std::string group = group_of(full_name);
    const std::string name = group.empty() ? full_name : "  " + full_name.substr(group.size() + 1);
    const std::string unit = key.unit.empty() ? "" : "  # " + key.unit;
    return fmt::format("{}: {}{}\n", name, value_text(key, full_name, settings), unit);
}

/// For a key with a placeholder in its name, all keys given for it; otherwise the key itself.
std::vector<std::string> names_of(const KeySpec& key, const Settings& settings) {
    if (!has_words(key)) return {key.name};
    std::vector<std::string> names;
    for (const auto& [name, value] : settings.entries())
        if (find_key(name) == &key) names.push_back(name);
    return names;
}

// Keys without a value (`~`) that are required only in other cases are left out.
bool is_written(const KeySpec& key, const Settings& settings) {
    if (!key.available) return false;
    return has_words(key) || settings.has(key.name) || key.need == Need::optional;
}

}  // namespace

std::string resolved_text(const Settings& settings, std::size_t grains, const NamedTexts& texts) {
    std::string text =
        fmt::format("{} every key, defaults filled in.\n# {} grains, fingerprint {}\n",
                    resolved_head, grains, case_hash(texts.grains));
    const auto fingerprint = [&](const char* of, const std::string& file) {
        if (!file.empty()) text += fmt::format("# {}, fingerprint {}\n", of, case_hash(file));
    };
    fingerprint("Walls inside the box", texts.walls);
    fingerprint("Script of the grains", texts.script);
    fingerprint("Function objects of the fluid", texts.functions);
    std::string group;
    for (const KeySpec& key : key_table()) {
        if (!is_written(key, settings)) continue;
        if (group_of(key.name) != group) text += group_of(key.name) + ":\n";
        group = group_of(key.name);
        for (const std::string& name : names_of(key, settings))
            text += line_of(key, name, settings);
    }
    return text;
}

}  // namespace turbidite
