// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/case_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "launcher/case/case_rule.hpp"
#include "launcher/case/grain_forms.hpp"
#include "launcher/case/key_value.hpp"
#include "launcher/case/law_rules.hpp"
#include "launcher/case/md_rules.hpp"
#include "launcher/case/scales.hpp"
#include "launcher/case/transport_schemes.hpp"

namespace turbidite {
namespace {

bool is_cyclic(const Settings& s, const char* key) {
    return s.text(key) == "cyclic";
}

Verdict opposite_sides(const Settings& s, const char* one, const char* other) {
    if (is_cyclic(s, one) == is_cyclic(s, other)) return std::nullopt;
    return Objection{fmt::format("Cyclic sides come in pairs, but {} = {}.", other, s.text(other)),
                     "Make both cyclic, or neither."};
}

Verdict left_right(const Settings& s) {
    return opposite_sides(s, "domain.left", "domain.right");
}
Verdict bottom_top(const Settings& s) {
    return opposite_sides(s, "domain.bottom", "domain.top");
}

Verdict region_in_box(const Settings& s) {
    const std::vector<double> region = real_list("grains.region", s.text("grains.region"));
    const std::vector<double> box = real_list("domain.size", s.text("domain.size"));
    if (region.at(0) <= box.at(0) && region.at(1) <= box.at(1)) return std::nullopt;
    return Objection{
        fmt::format("The region lies in the box, domain.size = {} D.", s.text("domain.size")),
        "Make it smaller, or remove it to fill the whole box."};
}

Verdict vertices_are_convex(const Settings& s) {
    const std::string fault =
        outline_fault(real_list("grains.vertices", s.text("grains.vertices")));
    if (fault.empty()) return std::nullopt;
    return Objection{fault + ".", "Corners go round a convex polygon, each once."};
}

bool is_lattice(const Settings& s) {
    return s.text("grains.generator") == "lattice" && !s.has("grains.file");
}

Objection lattice_objection(const char* what) {
    return {fmt::format("The lattice has discs of diameter D only, not {}.", what),
            "Use grains.generator: random, or give the grains in grains.file."};
}

Verdict lattice_has_discs(const Settings& s) {
    if (!is_lattice(s) || s.text("grains.shape") == "disc") return std::nullopt;
    return lattice_objection("other shapes");
}
Verdict lattice_has_radius(const Settings& s) {
    if (!is_lattice(s) || s.real("grains.radius") == 0.5) return std::nullopt;
    return lattice_objection("other radii");
}
Verdict lattice_has_one_size(const Settings& s) {
    if (!is_lattice(s) || s.real("grains.size_ratio") == 1.0) return std::nullopt;
    return lattice_objection("several sizes");
}

// The fluid's mesh knows the sides of the box only; soft-sphere adapters know no plates.
Verdict walls_have_an_engine(const Settings& s) {
    if (s.flag("fluid.enabled"))
        return Objection{"Walls inside the box are not seen by the fluid.",
                         "Set fluid.enabled: false, or remove them."};
    const std::string& adapter = s.text("grains.adapter");
    if (adapter == "yade-nscd" || adapter == "standalone-nscd") return std::nullopt;
    return Objection{
        fmt::format("Walls inside the box need a contact-dynamics adapter, not {}.", adapter),
        "Use grains.adapter: yade-nscd or standalone-nscd."};
}

Verdict at_least_one_window(const Settings& s) {
    if (s.real("time.end") >= s.real("time.step")) return std::nullopt;
    return Objection{
        fmt::format("The end must be at least one time.step = {} t_c.", s.text("time.step")),
        "Make the end later or the step smaller."};
}

// More windows than any machine plays, and far below the largest whole number.
constexpr double most_windows = 1e12;

Verdict countable_windows(const Settings& s) {
    if (s.real("time.end") / s.real("time.step") <= most_windows) return std::nullopt;
    return Objection{fmt::format("Up to time.end = {} t_c these are more than {:.0e} windows.",
                                 s.text("time.end"), most_windows),
                     "Use a larger step."};
}

// Step 2 is forward Euler: what moves at u_c may cross at most one cell, D/n, in a window.
Verdict transport_is_stable(const Settings& s) {
    const double cells = s.real("fluid.cells_per_diameter");
    if (!s.flag("fluid.enabled") || s.real("time.step") * cells <= 1.0 + 1e-12) return std::nullopt;
    return Objection{
        fmt::format("Explicit transport is unstable when u_c crosses more than one cell "
                    "in a step: at {} cells per diameter the step must be at most {} t_c.",
                    s.text("fluid.cells_per_diameter"), real_text(1.0 / cells)),
        "Use a smaller step or fewer cells."};
}

/// u_c D/nu, or nothing while the keys it follows from are not all valid.
std::optional<double> reynolds_of(const Settings& s) {
    const bool physical = s.text("scales.kind") == "physical";
    const std::vector<const char*> needed =
        physical ? std::vector<const char*>{"scales.diameter",      "scales.gravity",
                                            "scales.fluid_density", "scales.viscosity",
                                            "grains.density_ratio", "scales.compacity"}
                 : std::vector<const char*>{"fluid.reynolds", "grains.density_ratio",
                                            "scales.compacity"};
    for (const char* key : needed)
        if (!s.has(key)) return std::nullopt;
    return make_scales(s).reynolds;
}

Verdict scheme_is_known(const Settings& s) {
    const SchemeChoice choice = read_transport_scheme(s.text("fluid.transport_scheme"));
    if (choice.scheme) return std::nullopt;
    return Objection{choice.fault, choice.remedy};
}

/// The largest stable step [t_c] of a scheme of this kind, where the case's step is above it:
/// 2 nu/u2 with u = u_c (transport_schemes.hpp).
std::optional<double> step_limit_exceeded(const Settings& s, SchemeKind kind) {
    const SchemeChoice choice = read_transport_scheme(s.text("fluid.transport_scheme"));
    if (!s.flag("fluid.enabled") || !choice.scheme || choice.scheme->kind != kind)
        return std::nullopt;
    const std::optional<double> reynolds = reynolds_of(s);
    if (!reynolds || s.real("time.step") <= 2.0 / *reynolds * (1.0 + 1e-12)) return std::nullopt;
    return 2.0 / *reynolds;
}

Verdict scheme_is_stable(const Settings& s) {
    const auto limit = step_limit_exceeded(s, SchemeKind::central);
    if (!limit) return std::nullopt;
    return Objection{fmt::format("Explicit transport with central differences is unstable beyond "
                                 "2 nu/u_c^2 = 2/Re = {:.3g} t_c, and time.step = {}.",
                                 *limit, s.text("time.step")),
                     "Use Gauss limitedLinearV 1, which stays bounded, or a smaller step."};
}

Verdict whole_cells(const Settings& s) {
    if (!s.flag("fluid.enabled")) return std::nullopt;
    const double cells = s.real("fluid.cells_per_diameter");
    for (const double length : real_list("domain.size", s.text("domain.size"))) {
        const double count = length * cells;
        const double whole = std::max(1.0, std::round(count));
        if (std::abs(count - whole) > 1e-6)
            return Objection{fmt::format("With {} cells per diameter, {} D are {} cells; the mesh "
                                         "needs whole ones.",
                                         s.text("fluid.cells_per_diameter"), real_text(length),
                                         real_text(count)),
                             fmt::format("Use {} D.", real_text(whole / cells))};
    }
    return std::nullopt;
}

// Step 5 keeps a halo of three layers (halo_layers in foamFluidField.cpp), and a rank should have
// more than its halo.
constexpr double least_layers = 4.0;

Verdict ranks_have_cells(const Settings& s) {
    if (!s.flag("fluid.enabled")) return std::nullopt;
    const std::vector<double> size = real_list("domain.size", s.text("domain.size"));
    const bool rows = s.text("fluid.decomposition") == "rows";
    const double layers = size.at(rows ? 1 : 0) * s.real("fluid.cells_per_diameter");
    const double most = std::max(1.0, std::floor(layers / least_layers));
    if (static_cast<double>(s.integer("fluid.ranks")) <= most) return std::nullopt;
    return Objection{
        fmt::format("A rank needs {} {} of cells or more, and there are {}.",
                    real_text(least_layers), s.text("fluid.decomposition"), real_text(layers)),
        fmt::format("Use {} or fewer.", real_text(most))};
}

Verdict reynolds_follows(const Settings& s) {
    if (s.text("scales.kind") != "physical") return std::nullopt;
    return Objection{
        "With scales.kind: physical the Reynolds number follows from scales.viscosity.",
        "Remove it."};
}

Verdict limits_in_order(const Settings& s) {
    if (s.real("limits.stall_soft") <= s.real("limits.stall_hard")) return std::nullopt;
    return Objection{fmt::format("The hard limit comes after limits.stall_soft = {} s.",
                                 s.text("limits.stall_soft")),
                     "Enlarge it."};
}

Verdict script_has_a_yade(const Settings& s) {
    const std::string& adapter = s.text("grains.adapter");
    if (adapter.rfind("yade-", 0) == 0) return std::nullopt;
    return Objection{
        fmt::format("A script runs inside YADE, but grains.adapter = {} has none.", adapter),
        "Use grains.adapter: yade-nscd or yade-md, or remove grains.script."};
}

Verdict script_is_python(const Settings& s) {
    if (std::filesystem::path(s.text("grains.script")).extension() == ".py") return std::nullopt;
    return Objection{"A Python file, whose name ends with .py.", "Rename it."};
}

const std::vector<Rule>& rules() {
    static const std::vector<Rule> table = {
        {"domain.left", {"domain.right"}, left_right},
        {"domain.bottom", {"domain.top"}, bottom_top},
        {"domain.walls_file", {"fluid.enabled", "grains.adapter"}, walls_have_an_engine},
        {"grains.vertices", {}, vertices_are_convex},
        {"grains.shape", {"grains.generator"}, lattice_has_discs},
        {"grains.radius", {"grains.generator"}, lattice_has_radius},
        {"grains.size_ratio", {"grains.generator"}, lattice_has_one_size},
        {"grains.region", {"domain.size"}, region_in_box},
        {"grains.script", {"grains.adapter"}, script_has_a_yade},
        {"grains.script", {}, script_is_python},
        {"time.end", {"time.step"}, at_least_one_window},
        {"time.step", {"time.end"}, countable_windows},
        {"time.step", {"fluid.enabled", "fluid.cells_per_diameter"}, transport_is_stable},
        {"fluid.transport_scheme", {}, scheme_is_known},
        {"fluid.transport_scheme", {"fluid.enabled", "time.step", "scales.kind"}, scheme_is_stable},
        {"domain.size", {"fluid.enabled", "fluid.cells_per_diameter"}, whole_cells},
        {"fluid.ranks",
         {"fluid.enabled", "fluid.decomposition", "domain.size", "fluid.cells_per_diameter"},
         ranks_have_cells},
        {"fluid.reynolds", {"scales.kind"}, reynolds_follows},
        {"limits.stall_hard", {"limits.stall_soft"}, limits_in_order},
    };
    return table;
}

bool has_all(const Settings& settings, const Rule& rule) {
    return settings.has(rule.key) &&
           std::all_of(rule.reads.begin(), rule.reads.end(),
                       [&](const char* key) { return settings.has(key); });
}

CaseProblem blame(const Rule& rule, const Objection& objection, const Settings& settings,
                  const CaseEntries& entries) {
    const CaseEntry* entry = entries.find(rule.key);
    const std::string source = entries.entries.front().source;
    return {.source = entry ? entry->source : source,
            .line = entry ? entry->line : 0,
            .key = rule.key,
            .value = settings.text(rule.key) + (entry ? "" : " (default)"),
            .fault = {},
            .allowed = objection.allowed,
            .remedy = objection.remedy};
}

void add_scheme_notes(const Settings& settings, std::vector<std::string>& notes) {
    if (settings.text("coupling.scheme") != "joint") return;
    if (!settings.flag("fluid.enabled"))
        notes.push_back("coupling.scheme has no effect without a fluid");
    else if (settings.text("coupling.positions") == "contact")
        notes.push_back(
            "coupling.positions has no effect with coupling.scheme: joint; grains move with the "
            "contact velocity, with which the fluid agrees to coupling.tolerance");
}

}  // namespace

void check_rules(const Settings& settings, CaseEntries& entries) {
    for (const auto* list : {&rules(), &law_rules(), &md_rules()})
        for (const Rule& rule : *list) {
            if (!has_all(settings, rule)) continue;
            if (const Verdict objection = rule.check(settings))
                entries.problems.push_back(blame(rule, *objection, settings, entries));
        }
}

std::vector<std::string> rule_notes(const Settings& settings) {
    std::vector<std::string> notes;
    const double step = settings.real("time.step");
    const double end = settings.real("time.end");
    const double windows = std::round(end / step);
    if (std::abs(windows * step - end) > 1e-6 * end)
        notes.push_back(
            fmt::format("time.end = {} is not a whole number of steps; the run ends after "
                        "{} windows at {:.6g} t_c",
                        end, windows, windows * step));
    if (settings.real("output.interval") < step)
        notes.push_back("output.interval is shorter than time.step; every window is written");
    add_scheme_notes(settings, notes);
    if (settings.has("grains.region") && settings.has("grains.file"))
        notes.push_back("grains.region has no effect with grains.file");
    add_law_notes(settings, notes);
    add_md_notes(settings, notes);
    if (const auto limit = step_limit_exceeded(settings, SchemeKind::biased))
        notes.push_back(fmt::format(
            "fluid.transport_scheme = {}: its explicit transport may grow beyond "
            "2/Re = {:.3g} t_c, and time.step = {}; Gauss limitedLinearV 1 stays "
            "bounded",
            settings.text("fluid.transport_scheme"), *limit, settings.text("time.step")));
    return notes;
}

}  // namespace turbidite
