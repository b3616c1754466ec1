// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/case_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "coupler/keys/key_check.hpp"
#include "coupler/protocol/case_hash.hpp"
#include "coupler/protocol/files/whole_file.hpp"
#include "launcher/case/case_rules.hpp"
#include "launcher/case/files/case_entries.hpp"
#include "launcher/case/files/command_words.hpp"
#include "launcher/case/files/run_folder.hpp"
#include "launcher/case/grains/grain_abilities.hpp"
#include "launcher/case/grains/materials.hpp"
#include "launcher/case/grains/packing/space_lattice.hpp"
#include "launcher/case/keys/fluid_program.hpp"
#include "launcher/case/keys/keys.hpp"
#include "launcher/case/placed_case.hpp"
#include "launcher/case/resolved_text.hpp"
#include "launcher/case/run_settings.hpp"
#include "launcher/case/walls/space_walls.hpp"
#include "launcher/case/walls/wall_motion.hpp"

namespace turbidite {
namespace {

/// They are in the run folder; the grains of the case itself are not read.
void name_grains_file(CaseEntries& entries) {
    CaseEntry entry;
    entry.source = "--from";
    entry.key = "grains.file";
    entry.value = copied_grains;
    auto& list = entries.entries;
    list.erase(std::remove_if(list.begin(), list.end(),
                              [](const CaseEntry& other) { return other.key == "grains.file"; }),
               list.end());
    list.push_back(entry);
}

/// A computed packing overlaps by what its run allowed.
void accept_overlaps(Settings& settings) {
    if (!settings.has("limits.penetration") || !settings.has("grains.overlap")) return;
    settings.set("grains.overlap",
                 std::max(settings.real("grains.overlap"), settings.real("limits.penetration")));
}

/// Files in grains.command get absolute paths, with which any program may start it.
void place_command(Settings& settings, const std::filesystem::path& folder) {
    if (!settings.has("grains.command")) return;
    if (const auto words = command_words(settings.text("grains.command")))
        settings.set("grains.command", command_text(with_absolute_files(*words, folder)));
}

bool begins_in_motion(const PlacedGrain& grain) {
    if (grain.prescribed || !grain.motion.empty()) return false;
    for (const double part : {grain.vx, grain.vy, grain.vz, grain.wx, grain.wy, grain.spin})
        if (part != 0.0) return true;
    return false;
}

/// Of its velocity, far from others: rho_r/(rho_r + C V(R_h)/V) in an infinite fluid at rest.
double kept_by(const PlacedGrain& grain, const Settings& settings) {
    const double coefficient = in_space(settings) ? 0.5 : 1.0;
    const double ratio = grain.density.value_or(settings.real("grains.density_ratio"));
    return ratio / (ratio + coefficient * displaced_volume(settings, grain.radius));
}

/// The fluid around them begins at rest: its pressure shares their momentum out between them and
/// an added mass of it.
std::vector<std::string> motions_shared_with_fluid(const Settings& settings,
                                                   const Packing& grains) {
    if (!settings.flag("fluid.enabled")) return {};
    std::vector<double> kept;
    for (const PlacedGrain& grain : grains)
        if (begins_in_motion(grain)) kept.push_back(kept_by(grain, settings));
    if (kept.empty()) return {};
    const auto [least, most] = std::minmax_element(kept.begin(), kept.end());
    const std::string low = fmt::format("{:.2g}", *least), high = fmt::format("{:.2g}", *most);
    return {fmt::format(
        "{} grain(s) begin with a velocity or spin, in fluid that is at rest around them: in the "
        "first windows added mass takes its share of a velocity; far from others about {} of "
        "it stays, and an inflow, which begins at once, pushes them besides",
        kept.size(), low == high ? low : low + " to " + high)};
}

ResolvedCase resolve(Settings settings, PlacedCase placed, const CaseEntries& entries) {
    const GrainForms& forms = *placed.forms;
    Packing& grains = placed.start.grains;
    ResolvedCase result;
    result.script = std::move(placed.script);
    result.functions = std::move(placed.functions);
    result.scales = make_scales(settings);
    result.grains_csv = population_csv(grains, forms, material_names(settings));
    if (!placed.walls.empty())
        result.walls_csv =
            in_space(settings) ? space_walls_csv(placed.walls) : walls_csv(placed.walls);
    result.yaml =
        resolved_text(settings, grains.size(),
                      {result.grains_csv, result.walls_csv, result.script, result.functions.text});
    for (const auto& notes :
         {placed.start.notes, forms.notes, unfollowed_motions(settings, placed.walls, grains),
          motions_shared_with_fluid(settings, grains), rule_notes(settings, entries)})
        result.notes.insert(result.notes.end(), notes.begin(), notes.end());
    result.shapes = used_shapes(grains, forms);
    result.population = grain_states(grains, settings, result.scales);
    set_run_settings(settings, grains, placed.walls, result.scales);
    settings.set("run.hash", case_hash(result.yaml));
    result.packing = std::move(grains);
    result.settings = std::move(settings);
    return result;
}

/// Read, check, place, resolve: each takes values and gives values, with the problems found.
ResolvedCase resolved_case(CaseEntries entries, const std::filesystem::path& folder,
                           const GivenGrains& given, Machine machine) {
    CaseProblems problems = std::move(entries.problems);
    if (entries.entries.empty() && !problems.empty()) throw CaseRefused(std::move(problems));
    const CaseEntry* const file = given.earlier ? entries.find("grains.file") : nullptr;
    const std::string unread = file ? file->value : "";
    if (given.earlier) name_grains_file(entries);
    auto [settings, of_keys] = check_keys(key_table(), entries);
    append(problems, std::move(of_keys));
    choose_scheme(settings);
    choose_compacity(settings);
    const std::string of_program = choose_program(settings);
    append(problems, check_rules(settings, entries, machine));
    append(problems, check_materials(settings, entries));
    if (given.earlier) accept_overlaps(settings);
    PlacedCase placed = place(settings, entries, folder, given, !problems.empty());
    append(problems, std::move(placed.problems));
    if (!problems.empty()) throw CaseRefused(std::move(problems));
    name_copies(settings);
    place_command(settings, folder);
    ResolvedCase resolved = resolve(std::move(settings), std::move(placed), entries);
    if (!of_program.empty()) resolved.notes.push_back(of_program);
    if (!unread.empty())
        resolved.notes.push_back("grains.file = " + unread + " has no effect with --from");
    for (const CaseEntry& entry : entries.entries) resolved.given.push_back(entry.key);
    return resolved;
}

EarlierStart earlier_run(const std::string& text) {
    const EarlierRun run = parse_earlier_run(text);
    ResolvedCase resolved = load_run_folder(run.folder);
    std::vector<std::string> materials = material_names(resolved.settings);
    return {run, {resolved.scales, std::move(resolved.shapes), std::move(materials)}};
}

ResolvedCase load(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                  const std::string& from, const GivenGrains& given) {
    ResolvedCase result = resolved_case(read_case_entries(file, overrides), file.parent_path(),
                                        given, Machine::this_one);
    result.name = file.stem().string();
    result.file = std::filesystem::absolute(file).lexically_normal();
    result.overrides = overrides;
    result.from = from;
    return result;
}

}  // namespace

bool all_round(const ResolvedCase& resolved) {
    return std::all_of(resolved.shapes.begin(), resolved.shapes.end(),
                       [](const ShapeRecord& shape) { return shape.vertices.empty(); });
}

ResolvedCase load_case(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                       const std::string& from) {
    GivenGrains given;
    if (!from.empty()) given.earlier = earlier_run(from);
    return load(file, overrides, from, given);
}

ResolvedCase load_poured(const ResolvedCase& planned, const std::filesystem::path& pouring) {
    GivenGrains given;
    given.earlier = earlier_run(pouring.string());
    given.earlier->poured = true;
    ResolvedCase result = load(planned.file, planned.overrides, pouring.string(), given);
    result.hash_before_pouring = planned.settings.text("run.hash");
    return result;
}

ResolvedCase load_run_folder(const std::filesystem::path& folder,
                             const std::vector<std::string>& overrides, Machine machine) {
    const RunFolder paths{folder};
    ResolvedCase result = resolved_case(read_case_entries(paths.resolved_case(), overrides), folder,
                                        {paths.initial_grains(), {}}, machine);
    result.name = std::filesystem::absolute(folder).lexically_normal().filename().string();
    // Every program of the job hashes the file itself, which may have been edited by hand.
    if (overrides.empty())
        result.settings.set("run.hash", case_hash(read_whole(paths.resolved_case())));
    return result;
}

}  // namespace turbidite
