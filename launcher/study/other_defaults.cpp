// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/study/other_defaults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <regex>
#include <set>

#include "coupler/protocol/files/whole_file.hpp"
#include "launcher/case/files/case_entries.hpp"
#include "launcher/case/files/run_folder.hpp"
#include "launcher/job/folder/run_json.hpp"

namespace turbidite {
namespace {

using Values = std::map<std::string, std::string>;

/// Without the keys that have no value.
std::optional<Values> values_of(const std::string& resolved) {
    const CaseEntries read = case_entries_of(resolved, "case.yaml");
    if (!read.problems.empty()) return std::nullopt;
    Values values;
    for (const CaseEntry& entry : read.entries)
        if (!entry.is_null) values[entry.key] = entry.value;
    return values;
}

/// Of the grains, the walls and the script, which the head of a resolved case names.
std::set<std::string> fingerprints(const std::string& resolved) {
    static const std::regex one("# .*, fingerprint [0-9a-f]{16}");
    std::set<std::string> found;
    for (std::sregex_iterator at(resolved.begin(), resolved.end(), one), end; at != end; ++at)
        found.insert(at->str());
    return found;
}

bool is_of_grains(const std::string& fingerprint) {
    static const std::regex number("# [0-9]+ grains, .*");
    return std::regex_match(fingerprint, number);
}

using Record = nlohmann::ordered_json;

bool were_poured(const Record& record) {
    return !record.value("hash_before_pouring", "").empty();
}

double number_in(const Values& values, const std::string& key) {
    const auto at = values.find(key);
    return at == values.end() ? 0.0 : std::strtod(at->second.c_str(), nullptr);
}

/// Pouring raises grains.overlap to limits.penetration (accept_overlaps of case_file.cpp): that is
/// no other default.
void undo_accepted_overlaps(Values& then, const Values& now) {
    const double own = number_in(now, "grains.overlap");
    if (number_in(then, "grains.overlap") == std::max(own, number_in(then, "limits.penetration")) &&
        now.contains("grains.overlap"))
        then["grains.overlap"] = now.at("grains.overlap");
}

/// Keys that the case, the study or the command line named then; nothing in records of versions
/// that did not keep them.
std::optional<std::vector<std::string>> given_then(const Record& record) {
    const auto given = record.find("given");
    if (given == record.end() || !given->is_array()) return std::nullopt;
    return given->get<std::vector<std::string>>();
}

bool is_of_this_program(const Record& record) {
    const nlohmann::json played_by = record.value("versions", Record::object());
    return played_by == nlohmann::json(own_versions());  // in any order
}

bool has(const std::vector<std::string>& keys, const std::string& key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

std::string value_in(const Values& values, const std::string& key) {
    const auto at = values.find(key);
    return at == values.end() ? "nothing" : at->second;
}

std::set<std::string> keys_of(const Values& a, const Values& b) {
    std::set<std::string> keys;
    for (const Values* values : {&a, &b})
        for (const auto& [key, value] : *values) keys.insert(key);
    return keys;
}

}  // namespace

std::optional<std::vector<std::string>> other_defaults(const PlannedRun& run,
                                                       const std::filesystem::path& folder) {
    const std::string text = read_whole(RunFolder{folder}.resolved_case());
    const Record record = read_run_json(RunFolder{folder}.record());
    const auto given = given_then(record);
    auto then = values_of(text);
    const auto now = values_of(run.yaml);
    std::set<std::string> files_then = fingerprints(text), files_now = fingerprints(run.yaml);
    if (were_poured(record)) {
        // The plan does not know the packing, but all that it depends on; what stands in a file of
        // further grains is in the fingerprint of all of them.
        if (now && now->contains("grains.extra_file")) return std::nullopt;
        std::erase_if(files_then, is_of_grains), std::erase_if(files_now, is_of_grains);
        if (then) then->erase("grains.file");
        if (then && now) undo_accepted_overlaps(*then, *now);
    }
    if (!then || !now || files_then != files_now) return std::nullopt;
    std::vector<std::string> changes;
    for (const std::string& key : keys_of(*then, *now)) {
        const std::string before = value_in(*then, key), after = value_in(*now, key);
        if (before == after) continue;
        // Named now or then: no default. Without that list a default is that of another program.
        if (has(run.given, key)) return std::nullopt;
        if (given ? has(*given, key) : is_of_this_program(record)) return std::nullopt;
        changes.push_back(fmt::format("{}: {}, now {} by default", key, before, after));
    }
    return changes;
}

}  // namespace turbidite
