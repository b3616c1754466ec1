// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The program that moves the grains, and checks against its capabilities in the table of adapters.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "coupler/hub/schemes/scheme.hpp"
#include "granular_adapter/contact_keys/contact_keys.hpp"
#include "launcher/case/files/command_words.hpp"
#include "launcher/case/grains/grains_adapters.hpp"
#include "launcher/case/grains/soft_contact.hpp"
#include "launcher/case/keys/key_groups.hpp"

namespace turbidite {
namespace {

std::vector<Choice> adapter_choices() {
    std::vector<Choice> choices;
    for (const GrainsAdapter& adapter : grains_adapters())
        choices.push_back({adapter.name, adapter.help, adapter.available()});
    return choices;
}

bool has(const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

/// "yade-md knows no WHAT."; the remedy names the adapters that support it.
Objection unknown_to(const Settings& s, const std::string& what, bool (*can)(const GrainsAdapter&),
                     const std::string& first_remedy) {
    return {fmt::format("{} {}.", s.text("grains.adapter"), what),
            fmt::format("{}, or grains.adapter: {}.", first_remedy, adapters_that(can))};
}

Ruling scheme_is_known(const Settings& s) {
    if (!s.flag("fluid.enabled")) return std::nullopt;
    const GrainsAdapter& adapter = grains_adapter(s);
    const SchemeEntry& scheme = find_scheme(s.text("coupling.scheme"));
    if (supports(adapter, scheme)) return std::nullopt;
    const std::string remedy = std::string("Use ") + best_scheme(adapter).name;
    if (scheme.repeats)
        return unknown_to(
            s, "has no sub-steps to repeat: it takes the fluid's inertia into its contacts",
            [](const GrainsAdapter& a) { return a.repeats_windows; }, remedy);
    return unknown_to(
        s,
        "moves grains in sub-steps of its own and solves no contact problem that could include the "
        "fluid's inertia",
        [](const GrainsAdapter& a) { return a.takes_inertia; }, remedy);
}

Ruling no_cyclic_side(const Settings& s, const char* key) {
    if (grains_adapter(s).cyclic_sides || s.text(key) != "cyclic") return std::nullopt;
    return unknown_to(
        s, "does not support cyclic sides in this version",
        [](const GrainsAdapter& a) { return a.cyclic_sides; }, "Use wall or free");
}
Ruling left_is_not_cyclic(const Settings& s) {
    return no_cyclic_side(s, "domain.left");
}
Ruling bottom_is_not_cyclic(const Settings& s) {
    return no_cyclic_side(s, "domain.bottom");
}
Ruling front_is_not_cyclic(const Settings& s) {
    return in_space(s) ? no_cyclic_side(s, "domain.front") : std::nullopt;
}

Ruling shape_is_known(const Settings& s) {
    if (has(grains_adapter(s).shapes, s.text("grains.shape"))) return std::nullopt;
    return unknown_to(
        s, "supports discs and, in space, spheres",
        [](const GrainsAdapter& a) { return has(a.shapes, "polygon"); }, "Use disc");
}

Ruling law_is_known(const Settings& s) {
    const auto& laws = grains_adapter(s).laws;
    if (laws.empty() || has(laws, s.text("contact.law"))) return std::nullopt;
    return unknown_to(
        s, "has one coefficient of friction: coulomb",
        [](const GrainsAdapter& a) { return a.laws.empty(); }, "Use coulomb");
}

bool adheres_and_rolls(const GrainsAdapter& adapter) {
    return adapter.adhesion_and_rolling;
}

Ruling adhesion_is_known(const Settings& s) {
    if (grains_adapter(s).adhesion_and_rolling || s.text("contact.adhesion") == "none")
        return std::nullopt;
    return unknown_to(s, "has dry contacts only: none", adheres_and_rolls, "Use none");
}

Ruling rolling_is_known(const Settings& s) {
    if (grains_adapter(s).adhesion_and_rolling || s.real("contact.rolling_friction") == 0.0)
        return std::nullopt;
    return unknown_to(s, "has no rolling resistance: 0", adheres_and_rolls, "Use 0");
}

Ruling torsion_is_known(const Settings& s) {
    if (grains_adapter(s).adhesion_and_rolling || !s.has("contact.torsion_friction") ||
        s.real("contact.torsion_friction") == 0.0)
        return std::nullopt;
    return unknown_to(s, "has no resistance to torsion: 0", adheres_and_rolls, "Use 0");
}

// Soft-sphere adapters do not support plates.
Ruling walls_have_an_engine(const Settings& s) {
    if (grains_adapter(s).inner_walls) return std::nullopt;
    return Objection{
        fmt::format("Walls inside the box need a contact-dynamics adapter, not {}.",
                    s.text("grains.adapter")),
        fmt::format("Use grains.adapter: {}.",
                    adapters_that([](const GrainsAdapter& a) { return a.inner_walls; }))};
}

Ruling script_has_a_yade(const Settings& s) {
    if (grains_adapter(s).host == GrainsHost::yade) return std::nullopt;
    return Objection{fmt::format("A script runs inside YADE, but grains.adapter = {} has none.",
                                 s.text("grains.adapter")),
                     fmt::format("Use grains.adapter: {}, or remove grains.script.",
                                 adapters_that([](const GrainsAdapter& a) {
                                     return a.host == GrainsHost::yade;
                                 }))};
}

Ruling script_is_python(const Settings& s) {
    if (std::filesystem::path(s.text("grains.script")).extension() == ".py") return std::nullopt;
    return Objection{"A Python file, whose name ends with .py.", "Rename it."};
}

bool has_command(const Settings& s) {
    return s.has("grains.adapter") && grains_adapter(s).host == GrainsHost::command;
}
std::string idle_command(const Settings& s) {
    return has_command(s) ? "" : "with grains.adapter: " + s.text("grains.adapter");
}

Ruling command_has_words(const Settings& s) {
    if (command_words(s.text("grains.command"))) return std::nullopt;
    return Objection{"A program and its arguments, separated by spaces.",
                     "Close every quote, and name a program."};
}

/// To mpirun it is the end of a program's arguments, quoted or not.
Ruling command_is_one_program(const Settings& s) {
    const auto words = command_words(s.text("grains.command"));
    if (!words || !has(*words, ":")) return std::nullopt;
    return Objection{"mpirun takes a word \":\" for the end of the program.",
                     "Put the command with it into a script."};
}

Ruling ranks_are_supported(const Settings& s) {
    const GrainsAdapter& adapter = grains_adapter(s);
    if (s.integer("grains.ranks") <= adapter.most_ranks) return std::nullopt;
    if (adapter.most_ranks > 1)
        return Objection{
            fmt::format("{} runs on {} ranks at most.", adapter.name, adapter.most_ranks),
            "Use fewer."};
    return Objection{
        fmt::format("{} runs on one rank in this version.", adapter.name),
        fmt::format("Use 1, or grains.adapter: {}.",
                    adapters_that([](const GrainsAdapter& a) { return a.most_ranks > 1; }))};
}

Ruling solver_works_on_ranks(const Settings& s) {
    if (!shares_contacts(s) || is(s, "contact.solver", "nlgs")) return std::nullopt;
    return Objection{fmt::format("{} solves contacts on one rank.", s.text("contact.solver")),
                     "Use nlgs, or grains.ranks: 1."};
}

Ruling files_are_of_one_rank(const Settings& s) {
    if (!shares_contacts(s)) return std::nullopt;
    return Objection{"Contact problems shared by several ranks are not written in this version.",
                     "Remove it, or use grains.ranks: 1."};
}

/// Grains may have changed their rank by the end of the window that is to be repeated.
Ruling repeats_on_one_rank(const Settings& s) {
    if (has_command(s) || s.integer("grains.ranks") == 1 ||
        !find_scheme(s.text("coupling.scheme")).repeats)
        return std::nullopt;
    return Objection{"With several ranks grains cannot repeat a window in this version.",
                     "Use grains.ranks: 1, or coupling.scheme: split."};
}

// Damped polygons at rest need more sub-steps than discs: docs/md.md has the measured speeds.
constexpr double quiet_polygons = 20.0;

void impact_notes(const Settings& s, std::vector<std::string>& notes) {
    const auto has = [&](const char* name) { return !positive_coefficient(s, name).empty(); };
    if (s.text("contact.impact") == "newton" && has("friction") &&
        (has("restitution") || has("restitution_tangential")))
        notes.push_back(
            "contact.impact: newton with friction may create energy where several contacts of a "
            "grain have impacts at once; contact.impact: moreau never does");
}

void spring_notes(const Settings& s, std::vector<std::string>& notes) {
    if (!shape_is_round(s) && s.real("contact.md_substeps") < quiet_polygons)
        notes.push_back(
            fmt::format("contact.md_substeps = {}: polygons at rest keep moving a "
                        "little with fewer than {:g}",
                        s.text("contact.md_substeps"), quiet_polygons));
    const double wanted = s.real("contact.restitution"), least = restitution_of(1.0);
    if (wanted > 0.0 && wanted < least)
        notes.push_back(fmt::format(
            "contact.restitution = {}: {} uses its smallest, {:.3f}, that of critical damping",
            s.text("contact.restitution"), s.text("grains.adapter"), least));
}

void adapter_notes(const Settings& s, std::vector<std::string>& notes) {
    grains_adapter(s).contacts == Contacts::springs ? spring_notes(s, notes)
                                                    : impact_notes(s, notes);
}

}  // namespace

KeyGroup adapter_keys() {
    return {
        .keys =
            {{.name = "grains.adapter",
              .type = KeyType::choice,
              .fallback = grains_adapters().front().name,
              .choices = adapter_choices(),
              .help = "the program that moves the grains"},
             {.name = "grains.ranks",
              .type = KeyType::integer,
              .fallback = "1",
              .range = {.lower = 1.0},
              .help =
                  "MPI ranks of the grains program; more than one with standalone-nscd, lammps-md "
                  "and external"},
             {.name = "grains.command",
              .type = KeyType::text,
              .need = Need::conditional,
              .help = "program of your own and its arguments; the run folder is appended. Files "
                      "are relative to the case file",
              .when = "grains.adapter: external",
              .required = has_command,
              .idle = idle_command}},
        .rules = {{"coupling.scheme", {"grains.adapter", "fluid.enabled"}, scheme_is_known},
                  {"domain.left", {"grains.adapter"}, left_is_not_cyclic},
                  {"domain.bottom", {"grains.adapter"}, bottom_is_not_cyclic},
                  {"domain.front", {"grains.adapter", "dimension"}, front_is_not_cyclic},
                  {"domain.walls_file", {"grains.adapter"}, walls_have_an_engine},
                  {"grains.shape", {"grains.adapter"}, shape_is_known},
                  {"grains.script", {"grains.adapter"}, script_has_a_yade},
                  {"grains.script", {}, script_is_python},
                  {"grains.command", {}, command_has_words},
                  {"grains.command", {}, command_is_one_program},
                  {"grains.ranks", {"grains.adapter"}, ranks_are_supported},
                  {"grains.ranks", {"grains.adapter", "coupling.scheme"}, repeats_on_one_rank},
                  {"contact.solver", {"grains.ranks", "grains.adapter"}, solver_works_on_ranks},
                  {"contact.dump_interval",
                   {"grains.ranks", "grains.adapter"},
                   files_are_of_one_rank},
                  {"contact.law", {"grains.adapter"}, law_is_known},
                  {"contact.adhesion", {"grains.adapter"}, adhesion_is_known},
                  {"contact.rolling_friction", {"grains.adapter"}, rolling_is_known},
                  {"contact.torsion_friction", {"grains.adapter"}, torsion_is_known}},
        .notes = adapter_notes};
}

}  // namespace turbidite
