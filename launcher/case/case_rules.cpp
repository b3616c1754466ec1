// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/case_rules.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "launcher/case/grains/grains_adapters.hpp"
#include "launcher/case/keys/keys.hpp"

namespace turbidite {
namespace {

bool has_all(const Settings& settings, const Rule& rule) {
    return settings.has(rule.key) &&
           std::all_of(rule.reads.begin(), rule.reads.end(),
                       [&](const char* key) { return settings.has(key); });
}

/// Why a key has no effect; empty if it has one.
std::string idle_reason(const KeySpec& key, const Settings& settings) {
    const GrainsAdapter& adapter = grains_adapter(settings);
    const bool of_some = key.contacts != Contacts::any && adapter.contacts != Contacts::any;
    if (of_some && key.contacts != adapter.contacts) return "with grains.adapter: " + adapter.name;
    return key.idle ? key.idle(settings) : "";
}

/// The case of a run folder contains every key, so it does not show which ones the author has set.
bool is_resolved(const CaseEntries& entries) {
    const KeyTable& table = key_table();
    return std::all_of(table.begin(), table.end(), [&](const KeySpec& key) {
        return key.need != Need::fallback || entries.find(key.name);
    });
}

bool is_meant(const KeySpec& key, const CaseEntry* entry, const Settings& settings, bool resolved) {
    if (!entry || entry->is_null || !settings.has(entry->key)) return false;
    return !resolved ||
           settings.text(entry->key) !=
               (in_space(settings) ? key.in_space.fallback.value_or(key.fallback) : key.fallback);
}

/// One sentence for all keys with the same reason.
struct IdleKeys {
    std::string reason;
    std::vector<std::string> keys;

    std::string text() const {
        return fmt::format("{} {} no effect {}", fmt::join(keys, ", "),
                           keys.size() == 1 ? "has" : "have", reason);
    }
};

std::vector<IdleKeys> idle_keys(const Settings& settings, const CaseEntries& entries) {
    std::vector<IdleKeys> idle;
    const bool resolved = is_resolved(entries);
    for (const KeySpec& key : key_table()) {
        if (!is_meant(key, entries.find(key.name), settings, resolved)) continue;
        const std::string reason = idle_reason(key, settings);
        if (reason.empty()) continue;
        const auto same = std::find_if(idle.begin(), idle.end(), [&](const IdleKeys& other) {
            return other.reason == reason;
        });
        if (same == idle.end())
            idle.push_back({reason, {key.name}});
        else
            same->keys.push_back(key.name);
    }
    return idle;
}

}  // namespace

CaseProblem problem_with(const std::string& key, const Objection& objection,
                         const Settings& settings, const CaseEntries& entries) {
    const CaseEntry* entry = entries.find(key);
    return {.source = (entry ? *entry : entries.entries.front()).source,
            .line = entry ? entry->line : 0,
            .key = key,
            .value = settings.text(key) + (entry ? "" : " (default)"),
            .fault = {},
            .allowed = objection.allowed,
            .remedy = objection.remedy};
}

CaseProblems check_rules(const Settings& settings, const CaseEntries& entries, Machine machine) {
    CaseProblems problems;
    for (const KeyGroup& group : key_groups())
        for (const Rule& rule : group.rules) {
            if (!has_all(settings, rule)) continue;
            if (rule.of_machine && machine == Machine::any) continue;
            if (const Ruling objection = rule.check(settings))
                problems.push_back(problem_with(rule.key, *objection, settings, entries));
        }
    return problems;
}

std::vector<std::string> rule_notes(const Settings& settings, const CaseEntries& entries) {
    std::vector<std::string> notes;
    for (const KeyGroup& group : key_groups())
        if (group.notes) group.notes(settings, notes);
    for (const IdleKeys& idle : idle_keys(settings, entries)) notes.push_back(idle.text());
    return notes;
}

}  // namespace turbidite
