// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/md_rules.hpp"

#include <fmt/format.h>

#include "launcher/case/keys.hpp"
#include "launcher/case/soft_contact.hpp"

namespace turbidite {
namespace {

constexpr const char* other_adapter = "Use grains.adapter: yade-nscd, or remove what asks for it.";

Verdict scheme_is_split(const Settings& s) {
    if (!is_md(s) || !s.flag("fluid.enabled") || s.text("coupling.scheme") != "joint")
        return std::nullopt;
    return Objection{
        "yade-md moves grains in sub-steps of its own and solves no contact problem that could "
        "take the fluid's inertia in.",
        "Use split, or grains.adapter: yade-nscd."};
}

Verdict no_cyclic_side(const Settings& s, const char* key) {
    if (!is_md(s) || s.text(key) != "cyclic") return std::nullopt;
    return Objection{"yade-md knows no cyclic sides in this version.",
                     "Use wall or free, or grains.adapter: yade-nscd."};
}
Verdict left_is_not_cyclic(const Settings& s) {
    return no_cyclic_side(s, "domain.left");
}
Verdict bottom_is_not_cyclic(const Settings& s) {
    return no_cyclic_side(s, "domain.bottom");
}

Verdict grains_are_discs(const Settings& s) {
    if (!is_md(s) || s.text("grains.shape") == "disc") return std::nullopt;
    return Objection{"yade-md knows discs only: YADE has no polygons in the plane.",
                     "Use disc, or grains.adapter: yade-nscd."};
}

Verdict one_friction(const Settings& s) {
    if (!is_md(s) || s.text("contact.law") == "coulomb") return std::nullopt;
    return Objection{"yade-md has one coefficient of friction: coulomb.", other_adapter};
}

Verdict nothing_adheres(const Settings& s) {
    if (!is_md(s) || s.text("contact.adhesion") == "none") return std::nullopt;
    return Objection{"yade-md has dry contacts only: none.", other_adapter};
}

Verdict grains_roll_freely(const Settings& s) {
    if (!is_md(s) || s.real("contact.rolling_friction") == 0.0) return std::nullopt;
    return Objection{"yade-md has no rolling resistance: 0.", other_adapter};
}

/// Keys that mean something to contact problems, or to molecular dynamics, alone.
constexpr const char* nscd_keys[] = {"contact.theta",
                                     "contact.tolerance",
                                     "contact.iterations",
                                     "contact.recovery_fraction",
                                     "contact.recovery_speed",
                                     "contact.impact",
                                     "contact.solver",
                                     "contact.dump_interval",
                                     "contact.restitution_tangential",
                                     "contact.restitution_speed",
                                     "coupling.positions"};
constexpr const char* md_keys[] = {"contact.md_overlap", "contact.md_speed", "contact.md_stiffness",
                                   "contact.md_substeps", "coupling.md_hold"};

bool is_set(const Settings& settings, const char* key) {
    const KeySpec* spec = find_key(key);
    return spec && settings.has(key) && settings.text(key) != spec->fallback;
}

template <std::size_t count>
void note_idle_keys(const char* const (&keys)[count], const Settings& settings,
                    std::vector<std::string>& notes) {
    for (const char* key : keys)
        if (is_set(settings, key))
            notes.push_back(fmt::format("{} has no effect with grains.adapter: {}", key,
                                        settings.text("grains.adapter")));
}

void note_least_restitution(const Settings& settings, std::vector<std::string>& notes) {
    const double wanted = settings.real("contact.restitution"), least = restitution_of(1.0);
    if (wanted > 0.0 && wanted < least)
        notes.push_back(fmt::format(
            "contact.restitution = {}: yade-md gives its least, {:.3f}, that of critical damping",
            settings.text("contact.restitution"), least));
}

}  // namespace

bool is_md(const Settings& settings) {
    return settings.text("grains.adapter") == "yade-md";
}

const std::vector<Rule>& md_rules() {
    static const std::vector<Rule> table = {
        {"coupling.scheme", {"grains.adapter", "fluid.enabled"}, scheme_is_split},
        {"domain.left", {"grains.adapter"}, left_is_not_cyclic},
        {"domain.bottom", {"grains.adapter"}, bottom_is_not_cyclic},
        {"grains.shape", {"grains.adapter"}, grains_are_discs},
        {"contact.law", {"grains.adapter"}, one_friction},
        {"contact.adhesion", {"grains.adapter"}, nothing_adheres},
        {"contact.rolling_friction", {"grains.adapter"}, grains_roll_freely},
    };
    return table;
}

void add_md_notes(const Settings& settings, std::vector<std::string>& notes) {
    if (!is_md(settings)) return note_idle_keys(md_keys, settings, notes);
    note_idle_keys(nscd_keys, settings, notes);
    note_least_restitution(settings, notes);
    if (!settings.has("contact.md_stiffness")) return;
    for (const char* key : {"contact.md_overlap", "contact.md_speed"})
        if (is_set(settings, key))
            notes.push_back(fmt::format("{} has no effect beside contact.md_stiffness", key));
}

}  // namespace turbidite
