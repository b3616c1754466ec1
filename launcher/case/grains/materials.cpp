// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "launcher/case/case_rules.hpp"
#include "launcher/case/grains/grains_adapters.hpp"

namespace turbidite {
namespace {

constexpr const char* material_prefix = "contact.materials.";
constexpr const char* pair_prefix = "contact.pairs.";

/// The word after a prefix: "steel" in "contact.materials.steel.friction".
std::string word_behind(const std::string& prefix, const std::string& key) {
    if (key.rfind(prefix, 0) != 0) return "";
    return key.substr(prefix.size(), key.find('.', prefix.size()) - prefix.size());
}

double given(const Settings& s, const std::string& key, double otherwise) {
    return s.has(key) ? s.real(key) : otherwise;
}

/// Of a material; what it does not give is that of contact.*, which are those of "default".
double of_material(const Settings& s, const std::string& name, const std::string& coefficient) {
    const double fallback = given(s, "contact." + coefficient, 0.0);
    return given(s, material_prefix + name + "." + coefficient, fallback);
}

/// Of a pair; what it does not give is the smaller value of its materials.
double of_pair(const Settings& s, const std::string& pair, const std::string& coefficient) {
    const auto dash = pair.find('-');
    const double smaller = std::min(of_material(s, pair.substr(0, dash), coefficient),
                                    of_material(s, pair.substr(dash + 1), coefficient));
    return given(s, pair_prefix + pair + "." + coefficient, smaller);
}

/// Of "steel", or of a pair, "glass-steel".
std::optional<Objection> unknown_material(const std::string& pair,
                                          const std::vector<std::string>& names) {
    const auto dash = pair.find('-');
    // Without a dash both are the whole name: npos + 1 is 0.
    for (const std::string& name : {pair.substr(0, dash), pair.substr(dash + 1)})
        if (std::find(names.begin(), names.end(), name) == names.end())
            return Objection{
                fmt::format("There is no material {}; there are {}.", name, fmt::join(names, ", ")),
                "Describe it below contact.materials, or correct the name."};
    return std::nullopt;
}

/// Key groups below contact.pairs: a pair may be written in either order, but not in both.
std::optional<Objection> written_twice(const std::string& pair, const std::set<std::string>& seen) {
    const auto dash = pair.find('-');
    if (dash == std::string::npos) return std::nullopt;
    const std::string first = pair.substr(0, dash), second = pair.substr(dash + 1);
    const std::string other = pair_prefix + second + "-" + first;
    if (first == second || !seen.contains(other)) return std::nullopt;
    return Objection{
        fmt::format("{} and {}{} are one pair: either would hide what the other gives.", other,
                    pair_prefix, pair),
        fmt::format("Write all of its coefficients below {}.", other)};
}

/// The friction of a material or a pair.
std::optional<Objection> unfit(const Settings& s, const std::string& material,
                               const std::string& pair) {
    const auto value = [&](const char* coefficient) {
        return pair.empty() ? of_material(s, material, coefficient) : of_pair(s, pair, coefficient);
    };
    const double sliding = value("friction"), sticking = value("static_friction");
    if (is(s, "contact.law", "static-dynamic") && sticking < sliding)
        return Objection{fmt::format("The static coefficient must be at least the sliding one: "
                                     "static_friction = {}, friction = {}.",
                                     sticking, sliding),
                         "Increase static_friction."};
    return std::nullopt;
}

}  // namespace

std::vector<std::string> material_names(const Settings& settings) {
    std::vector<std::string> names{"default"};
    for (const auto& [key, value] : settings.entries())
        if (const std::string name = word_behind(material_prefix, key);
            // Settings are sorted by key: those of one material follow each other.
            !name.empty() && name != "default" && name != names.back())
            names.push_back(name);
    return names;
}

CaseProblems check_materials(const Settings& settings, const CaseEntries& entries) {
    CaseProblems problems;
    const std::vector<std::string> names = material_names(settings);
    const bool known = !settings.has("grains.adapter") || grains_adapter(settings).materials;
    std::set<std::string> seen;
    for (const auto& [key, value] : settings.entries()) {
        const std::string material = word_behind(material_prefix, key);
        const std::string pair = word_behind(pair_prefix, key);
        if (material.empty() && pair.empty()) continue;
        const std::string group = key.substr(0, key.rfind('.'));
        // Once per material or pair, not once per coefficient.
        if (!seen.insert(group).second) continue;
        std::optional<Objection> objection;
        if (material == "default")
            objection = Objection{"The material default has the coefficients of contact.*.",
                                  "Set those, or choose another name."};
        else if (!known)
            objection = Objection{
                fmt::format("{} has one material, contact.*.", settings.text("grains.adapter")),
                fmt::format("Remove it, or use grains.adapter: {}.",
                            adapters_that([](const GrainsAdapter& a) { return a.materials; }))};
        else if (!pair.empty())
            objection = unknown_material(pair, names);
        if (!objection && !pair.empty()) objection = written_twice(pair, seen);
        if (!objection && settings.has("contact.law")) objection = unfit(settings, material, pair);
        if (objection) problems.push_back(problem_with(key, *objection, settings, entries));
    }
    if (settings.has("domain.material"))
        if (const auto objection = unknown_material(settings.text("domain.material"), names))
            problems.push_back(problem_with("domain.material", *objection, settings, entries));
    return problems;
}

}  // namespace turbidite
