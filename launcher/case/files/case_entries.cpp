// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/files/case_entries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <unordered_map>

#include "launcher/case/files/file_names.hpp"
#include "launcher/case/files/yaml_tree.hpp"

namespace turbidite {
namespace {

std::string item_text(const YAML::Node& node) {
    return node.IsScalar() ? node.Scalar() : YAML::Dump(node);
}

CaseEntry leaf(const std::string& key, const YAML::Node& node) {
    CaseEntry entry;
    entry.key = key;
    entry.is_null = node.IsNull();
    entry.is_list = node.IsSequence();
    if (node.IsScalar()) entry.value = node.Scalar();
    if (!entry.is_list) return entry;
    for (const YAML::Node& item : node) {
        entry.items.push_back(item_text(item));
        entry.value += (entry.value.empty() ? "" : ", ") + entry.items.back();
    }
    entry.value = "[" + entry.value + "]";
    return entry;
}

struct Place {
    std::string source;
    bool has_lines = true;
};

void flatten(const std::string& prefix, const YAML::Node& node, const Place& place,
             std::vector<CaseEntry>& entries) {
    for (const auto& item : node) {
        const std::string key = prefix + item_text(item.first);
        if (item.second.IsMap()) {
            flatten(key + ".", item.second, place, entries);
            continue;
        }
        CaseEntry entry = leaf(key, item.second);
        entry.source = place.source;
        entry.line = place.has_lines ? item.first.Mark().line + 1 : 0;
        entries.push_back(entry);
    }
}

void report_repeated(CaseEntries& result) {
    std::unordered_map<std::string, const CaseEntry*> firsts;
    for (const CaseEntry& entry : result.entries) {
        const CaseEntry* first = firsts.emplace(entry.key, &entry).first->second;
        if (first == &entry) continue;
        result.problems.push_back(
            {.source = entry.source,
             .line = entry.line,
             .key = entry.key,
             .value = entry.value,
             .fault = "is given twice",
             .allowed = first->line > 0
                            ? fmt::format("It is already {} in line {}.", first->value, first->line)
                            : fmt::format("It is already {}.", first->value),
             .remedy = "Keep one of the two."});
    }
}

void read_document(const std::string& text, const Place& place, CaseEntries& result) {
    try {
        const YAML::Node document = yaml_tree(text);
        if (!document.IsMap())
            result.problems.push_back(problem_at(place.source, 0, "contains no keys",
                                                 "A case is a list of `key: value` in groups.",
                                                 "See configs/ for examples."));
        else
            flatten("", document, place, result.entries);
    } catch (const YamlFault& refused) {
        result.problems.push_back(
            problem_at(place.source, place.has_lines ? refused.line : 0, refused.fault,
                       "A case is a list of `key: value` in groups.", refused.remedy));
    }
}

void read_file(const std::filesystem::path& file, CaseEntries& result) {
    std::ifstream input(file);
    if (is_folder(file) || !input) {
        result.problems.push_back(problem_at(file.string(), 0, "cannot be read",
                                             "A case file (YAML) is needed.", "Check the path."));
        return;
    }
    const std::string text{std::istreambuf_iterator<char>(input), {}};
    if (text.empty())
        result.problems.push_back(problem_at(file.string(), 0, "is empty",
                                             "A case is a list of `key: value` in groups.",
                                             "See configs/ for examples."));
    else
        read_document(text, {file.filename().string()}, result);
}

void replace(const CaseEntry& entry, std::vector<CaseEntry>& entries) {
    const auto same = [&](const CaseEntry& other) { return other.key == entry.key; };
    entries.erase(std::remove_if(entries.begin(), entries.end(), same), entries.end());
    entries.push_back(entry);
}

}  // namespace

CaseEntries case_entries_of(const std::string& text, const std::string& source) {
    CaseEntries result;
    read_document(text, {source}, result);
    report_repeated(result);
    return result;
}

CaseEntries entries_of_override(const std::string& text) {
    const Place place{"--set", false};
    CaseEntries result;
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
        result.problems.push_back(problem_at("--set " + text, 0, "has no value",
                                             "An override is key=value.",
                                             "Write for example --set contact.friction=0.5."));
        return result;
    }
    const std::string value = text.substr(equals + 1);
    const auto first = value.find_first_not_of(" \t");
    if (first == std::string::npos || value[first] == '#') {
        // An empty variable of a script would take the key out.
        const std::string key = text.substr(0, equals);
        result.problems.push_back(problem_at("--set", 0, key + " has no value",
                                             "An override is key=value.",
                                             "To take a key out of the case write " + key + "=~"));
        return result;
    }
    read_document(text.substr(0, equals) + ": " + value, place, result);
    report_repeated(result);
    return result;
}

std::string quoted_override(const std::string& key, const std::string& text) {
    YAML::Emitter quoted;
    quoted << YAML::DoubleQuoted << text;
    return key + "=" + quoted.c_str();
}

CaseEntries read_case_entries(const std::filesystem::path& file,
                              const std::vector<std::string>& overrides) {
    CaseEntries result;
    read_file(file, result);
    // What --set gives is no case by itself: its missing keys would be told, too.
    if (result.entries.empty() && !result.problems.empty()) return result;
    report_repeated(result);
    for (const std::string& text : overrides) {
        CaseEntries extra = entries_of_override(text);
        for (const CaseEntry& entry : extra.entries) replace(entry, result.entries);
        append(result.problems, std::move(extra.problems));
    }
    return result;
}

}  // namespace turbidite
