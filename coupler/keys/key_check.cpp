// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/keys/key_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "coupler/keys/gone_keys.hpp"
#include "coupler/keys/key_value.hpp"
#include "coupler/keys/nearest_name.hpp"

namespace turbidite {
namespace {

/// The value in its normal form, or nothing if it is refused (`problem` is then filled in).
using Checked = std::optional<std::string>;

CaseProblem problem_of(const CaseEntry& entry, const KeySpec& key) {
    return {.source = entry.source,
            .line = entry.line,
            .key = entry.key,
            .value = entry.value,
            .fault = {},
            .allowed = allowed_values(key),
            .remedy = key.remedy};
}

Checked check_choice(const KeySpec& key, const std::string& value, CaseProblem& problem) {
    std::vector<std::string> available;
    for (const Choice& choice : key.choices) {
        if (choice.available) available.push_back(choice.name);
        if (choice.name != value) continue;
        if (choice.available) return value;
        problem.allowed = value + " is not available in this version. " + problem.allowed;
    }
    problem.remedy = fmt::format("Use {}.", fmt::join(nearest_names(value, available), " or "));
    return std::nullopt;
}

Checked check_real(const KeySpec& key, const std::string& value, CaseProblem& problem) {
    const auto number = parse_real(value);
    if (number && std::isfinite(*number) && key.range.contains(*number)) return real_text(*number);
    if (!number) problem.allowed = fmt::format("\"{}\" is not a number. ", value) + problem.allowed;
    if (number && !std::isfinite(*number))
        problem.allowed = "The value must be finite. " + problem.allowed;
    return std::nullopt;
}

Checked check_integer(const KeySpec& key, const std::string& value, CaseProblem& problem) {
    const auto number = parse_integer(value);
    if (number && key.range.contains(static_cast<double>(*number))) return std::to_string(*number);
    if (!number)
        problem.allowed = fmt::format("\"{}\" is not a whole number. ", value) + problem.allowed;
    return std::nullopt;
}

Checked check_list(const KeySpec& key, const CaseEntry& entry, CaseProblem& problem) {
    if (!entry.is_list || entry.items.empty()) {
        problem.allowed = "A list of numbers in brackets is needed. " + problem.allowed;
        return std::nullopt;
    }
    if (key.entries > 0 && static_cast<int>(entry.items.size()) != key.entries) return std::nullopt;
    std::vector<double> values;
    for (const std::string& item : entry.items) {
        const auto number = parse_real(item);
        if (!number || !std::isfinite(*number) || !key.range.contains(*number)) return std::nullopt;
        values.push_back(*number);
    }
    return list_text(values);
}

Checked check_flag(const std::string& value) {
    const auto flag = parse_flag(value);
    return flag ? Checked(*flag ? "true" : "false") : std::nullopt;
}

Checked check_value(const KeySpec& key, const CaseEntry& entry, CaseProblem& problem) {
    if (key.type == KeyType::real_list) return check_list(key, entry, problem);
    if (entry.is_list) {
        problem.allowed = fmt::format("A list is not allowed here. {}", problem.allowed);
        return std::nullopt;
    }
    switch (key.type) {
        case KeyType::choice:
            return check_choice(key, entry.value, problem);
        case KeyType::real:
            return check_real(key, entry.value, problem);
        case KeyType::integer:
            return check_integer(key, entry.value, problem);
        case KeyType::flag:
            return check_flag(entry.value);
        default:
            return entry.value.empty() ? std::nullopt : Checked(entry.value);
    }
}

/// As the user would write them who has written `written`.
std::vector<std::string> names_as_written(const KeyTable& table, const std::string& written) {
    std::vector<std::string> names;
    for (const KeySpec& key : table) names.push_back(with_words_of(written, key.name));
    return names;
}

/// "contact", "contact.materials", "contact.materials.steel".
bool is_group(const KeyTable& table, const std::string& name) {
    return std::any_of(table.begin(), table.end(), [&](const KeySpec& key) {
        const auto end = key.name.rfind('.');
        return key.name.rfind(name + ".", 0) == 0 ||
               (end != std::string::npos && find_key({{.name = key.name.substr(0, end)}}, name));
    });
}

CaseProblem unknown_key(const KeyTable& table, const CaseEntry& entry) {
    CaseProblem problem{.source = entry.source,
                        .line = entry.line,
                        .key = entry.key,
                        .value = entry.value,
                        .fault = "is unknown",
                        .allowed = {},
                        .remedy = "`turbidite keys` lists them all."};
    if (is_group(table, entry.key)) {
        problem.fault = "is a group of keys, not a key";
        problem.allowed = "Write its keys below it, indented.";
        return problem;
    }
    if (std::string why = why_gone(entry.key); !why.empty()) {
        problem.fault = "is no longer a key";
        problem.allowed = std::move(why);
        problem.remedy = "Remove it.";
        return problem;
    }
    const std::vector<std::string> names = names_as_written(table, entry.key);
    const std::vector<std::string> near = resembling(entry.key, names);
    const std::string help =
        near.size() == 1 ? fmt::format("({})", find_key(table, near.front())->help) : "";
    problem.allowed = did_you_mean(entry.key, names, help);
    return problem;
}

/// 3 if the case says so; its rule tells a value that is neither.
int dimension_of(const CaseEntries& entries) {
    const CaseEntry* entry = entries.find("dimension");
    return entry != nullptr && entry->value == "3" ? 3 : 2;
}

bool exists(const KeySpec& key, int dimension) {
    return key.dimension == 0 || key.dimension == dimension;
}

/// Whether the case has a value for it where it gives none.
bool has_fallback(const KeySpec& key, int dimension) {
    if (dimension == 3 && key.in_space.fallback) return !key.in_space.fallback->empty();
    return key.need == Need::fallback;
}

/// Whether null may stand for it, as if it were not there. Keys of space are, in the plane.
bool may_be_null(const KeySpec& key, int dimension) {
    if (key.dimension == 3 && dimension == 2) return true;
    const bool may_be_absent = key.need == Need::optional || key.need == Need::conditional;
    return may_be_absent && !has_fallback(key, dimension);
}

void check_entry(const KeyTable& table, const CaseEntry& entry, int dimension, Settings& settings,
                 CaseProblems& problems) {
    const KeySpec* found = find_key(table, entry.key);
    if (found == nullptr) return problems.push_back(unknown_key(table, entry));
    // `key:` without a value is as good as no key, where there need not be one.
    if (entry.is_null && may_be_null(*found, dimension)) return;
    // Before its value is looked at: in space a key may have other numbers, defaults and words.
    const KeySpec spec = in_dimension(*found, dimension);
    const KeySpec* key = &spec;
    CaseProblem problem = problem_of(entry, *key);
    if (!exists(*key, dimension)) {
        problem.allowed = fmt::format("This key exists with dimension: {} only.", key->dimension);
        problem.remedy = "Remove it, or change the dimension.";
        return problems.push_back(problem);
    }
    if (entry.is_null) {
        problem.fault = "has no value";
        return problems.push_back(problem);
    }
    if (!key->available) {
        problem.allowed = "This key is not available in this version.";
        problem.remedy = "Remove it.";
        return problems.push_back(problem);
    }
    const Checked value = check_value(*key, entry, problem);
    if (value)
        settings.set(entry.key, *value);
    else
        problems.push_back(problem);
}

void fill_defaults(const KeyTable& table, const CaseEntries& entries, int dimension,
                   Settings& settings) {
    for (const KeySpec& key : table) {
        const bool in_space = dimension == 3 && key.in_space.fallback;
        if (entries.find(key.name) != nullptr || !(in_space || key.need == Need::fallback))
            continue;
        const std::string& fallback = in_space ? *key.in_space.fallback : key.fallback;
        if (!in_space || !fallback.empty()) settings.set(key.name, fallback);
    }
}

CaseProblem missing_key(const std::string& source, const KeySpec& key) {
    const std::string reason = key.when.empty() ? "" : fmt::format(" (needed with {})", key.when);
    return {.source = source,
            .line = 0,
            .key = key.name,
            .value = {},
            .fault = "is missing" + reason,
            .allowed = allowed_values(key),
            .remedy = key.remedy.empty() ? fmt::format("Add it: {}.", key.help) : key.remedy};
}

/// Not there, or null in its place; null that is refused has been told.
bool is_absent(const CaseEntry* entry, const KeySpec& key, int dimension) {
    return entry == nullptr || (entry->is_null && may_be_null(key, dimension));
}

bool is_needed(const KeySpec& key, const Settings& settings) {
    if (key.need == Need::required) return true;
    return key.need == Need::conditional && key.required(settings);
}

}  // namespace

CheckedKeys check_keys(const KeyTable& table, const CaseEntries& entries) {
    CheckedKeys checked;
    const std::string source = entries.entries.empty() ? "" : entries.entries.front().source;
    const int dimension = dimension_of(entries);
    for (const CaseEntry& entry : entries.entries)
        check_entry(table, entry, dimension, checked.settings, checked.problems);
    // Before conditional keys are asked for: whether they are needed may depend on defaults.
    fill_defaults(table, entries, dimension, checked.settings);
    for (const KeySpec& key : table)
        if (is_needed(key, checked.settings) && is_absent(entries.find(key.name), key, dimension))
            checked.problems.push_back(missing_key(source, in_dimension(key, dimension)));
    return checked;
}

}  // namespace turbidite
