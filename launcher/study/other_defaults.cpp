// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/study/other_defaults.hpp"

#include <fmt/format.h>

#include <algorithm>
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
    return fingerprint.find(" grains, ") != std::string::npos;
}

bool were_poured(const std::filesystem::path& folder) {
    return !read_run_json(RunFolder{folder}.record()).value("hash_before_pouring", "").empty();
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
    auto then = values_of(text);
    const auto now = values_of(run.yaml);
    std::set<std::string> files_then = fingerprints(text), files_now = fingerprints(run.yaml);
    if (were_poured(folder)) {
        // The plan does not know the packing, but all that it depends on.
        std::erase_if(files_then, is_of_grains), std::erase_if(files_now, is_of_grains);
        if (then) then->erase("grains.file");
    }
    if (!then || !now || files_then != files_now) return std::nullopt;
    std::vector<std::string> changes;
    for (const std::string& key : keys_of(*then, *now)) {
        const std::string before = value_in(*then, key), after = value_in(*now, key);
        if (before == after) continue;
        if (std::find(run.given.begin(), run.given.end(), key) != run.given.end())
            return std::nullopt;
        changes.push_back(fmt::format("{}: {}, now {} by default", key, before, after));
    }
    return changes;
}

}  // namespace turbidite
