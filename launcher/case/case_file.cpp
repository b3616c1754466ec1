// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/case_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

#include "coupler/hub/schemes/scheme.hpp"
#include "coupler/keys/key_check.hpp"
#include "coupler/keys/key_value.hpp"
#include "coupler/protocol/case_hash.hpp"
#include "coupler/protocol/mesh_rows.hpp"
#include "launcher/case/case_entries.hpp"
#include "launcher/case/case_rules.hpp"
#include "launcher/case/command_words.hpp"
#include "launcher/case/earlier_run.hpp"
#include "launcher/case/file_names.hpp"
#include "launcher/case/grain_forms.hpp"
#include "launcher/case/grains_adapters.hpp"
#include "launcher/case/inner_walls.hpp"
#include "launcher/case/keys.hpp"
#include "launcher/case/materials.hpp"
#include "launcher/case/population.hpp"
#include "launcher/case/resolved_text.hpp"
#include "launcher/case/run_folder.hpp"
#include "launcher/case/soft_contact.hpp"
#include "launcher/case/wall_motion.hpp"

namespace turbidite {
namespace {

// The run folder contains a copy of the grains, and the resolved case names this copy, so that the
// folder can be moved to another machine.
constexpr auto copied_grains = "grains/initial.csv";
constexpr auto copied_walls = "grains/walls.csv";

std::string file_text(const std::filesystem::path& file) {
    std::ifstream input(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(input), {}};
}

struct Population {
    Packing grains;
    PopulationSource source;
    std::vector<std::string> notes;
};

/// Existing grains: those of a run folder, or of another run.
struct EarlierStart {
    EarlierRun run;
    EarlierCase earlier;
};
struct GivenGrains {
    std::filesystem::path file = {};
    std::optional<EarlierStart> earlier = {};
};

double overlap_of(const Settings& settings) {
    return settings.real("grains.overlap");
}

PackingBox packing_box(const Settings& settings) {
    const auto size = real_list("domain.size", settings.text("domain.size"));
    return {.width = size.at(0),
            .height = size.at(1),
            .periodic_x = settings.text("domain.left") == "cyclic",
            .periodic_y = settings.text("domain.bottom") == "cyclic"};
}

SolidSides solid_sides(const Settings& settings) {
    const auto solid = [&](const char* key) {
        return settings.text(key) == "wall" || settings.text(key) == "inflow";
    };
    return {solid("domain.left"), solid("domain.right"), solid("domain.bottom"),
            solid("domain.top")};
}

std::optional<PackingRegion> packing_region(const Settings& settings) {
    if (!settings.has("grains.region")) return std::nullopt;
    const auto size = real_list("grains.region", settings.text("grains.region"));
    return PackingRegion{size.at(0), size.at(1)};
}

PackingRequest packing_request(const Settings& settings, const GrainForms& forms) {
    const bool counted = settings.has("grains.count");
    return {.box = packing_box(settings),
            .region = packing_region(settings),
            .compacity = settings.real("grains.compacity"),
            .count = counted ? settings.integer("grains.count") : 0,
            .jitter = settings.real("grains.jitter"),
            .seed = static_cast<std::uint64_t>(settings.integer("random.seed")),
            .forms = &forms,
            .size_ratio = settings.real("grains.size_ratio")};
}

const GeneratorEntry& generator(const std::string& name) {
    const auto& list = generator_list();
    return *std::find_if(list.begin(), list.end(),
                         [&](const GeneratorEntry& entry) { return entry.name == name; });
}

// The key whose value a generator refuses.
std::string blamed_key(const Settings& settings) {
    return settings.text("grains.generator") == "lattice" ? "grains.compacity" : "grains.count";
}

Population generated_grains(const Settings& settings, const GrainForms& forms,
                            CaseEntries& entries) {
    PackingResult result =
        generator(settings.text("grains.generator")).make(packing_request(settings, forms));
    const std::string key = blamed_key(settings);
    const CaseEntry* entry = entries.find(key);
    const std::string file = entries.entries.front().source;
    if (!result.refusal.empty())
        entries.problems.push_back({.source = entry ? entry->source : file,
                                    .line = entry ? entry->line : 0,
                                    .key = key,
                                    .value = settings.text(key) + (entry ? "" : " (default)"),
                                    .fault = {},
                                    .allowed = result.refusal,
                                    .remedy = {}});
    return {std::move(result.grains), {file, {}}, std::move(result.notes)};
}

CaseProblem missing_file(const CaseEntries& entries, const std::string& key,
                         const std::filesystem::path& file) {
    const CaseEntry* entry = entries.find(key);
    return {.source = entry ? entry->source : file.string(),
            .line = entry ? entry->line : 0,
            .key = key,
            .value = entry ? entry->value : file.filename().string(),
            .fault = {},
            .allowed = fmt::format("There is no file {}.", file.lexically_normal().string()),
            .remedy = "Paths are relative to the folder of the case file."};
}

Population grains_from_file(const std::filesystem::path& file, const Settings& settings,
                            const GrainForms& forms, CaseEntries& entries) {
    if (!is_file(file)) {
        entries.problems.push_back(missing_file(entries, "grains.file", file));
        return {};
    }
    PopulationFile read =
        read_population_csv(file, forms, material_names(settings), motion_names(settings));
    for (CaseProblem& problem : read.problems) entries.problems.push_back(std::move(problem));
    if (!read.problems.empty()) return {};  // unreadable positions would be checked as 0
    return {std::move(read.grains), std::move(read.source), {}};
}

void check_grains(const Population& population, const Settings& settings, const GrainForms& forms,
                  CaseEntries& entries) {
    auto problems = check_population(population.grains, population.source, packing_box(settings),
                                     solid_sides(settings), forms, overlap_of(settings));
    for (CaseProblem& problem : problems) entries.problems.push_back(std::move(problem));
}

void refuse_grain(const Population& population, std::size_t i, const std::string& fault,
                  const std::string& allowed, const std::string& remedy, CaseEntries& entries) {
    const auto& lines = population.source.lines;
    entries.problems.push_back(
        {.source = population.source.name,
         .line = i < lines.size() ? lines[i] : 0,
         .key = {},
         .value = {},
         .fault = fmt::format("grain {}: {}", population.grains[i].id, fault),
         .allowed = allowed,
         .remedy = remedy});
}

/// Fewer cells show neither a grain's outline nor the flow around it.
constexpr double least_cells_across = 4.0;

/// The first grain that reaches stretched rows.
void check_equal_rows(const Population& population, const Settings& settings,
                      CaseEntries& entries) {
    const auto rows =
        mesh_rows(settings, real_list("domain.size", settings.text("domain.size")).at(1));
    if (!rows) return;
    const double top = rows->equal_height();
    const auto reaches = [&](const PlacedGrain& g) { return g.y + g.radius > top * (1.0 + 1e-12); };
    const auto at = std::find_if(population.grains.begin(), population.grains.end(), reaches);
    if (at == population.grains.end()) return;
    refuse_grain(population, at - population.grains.begin(),
                 fmt::format("reaches y = {:.4g} D", at->y + at->radius),
                 fmt::format("Grains stay where rows of cells are equal, below {:.4g} D "
                             "(fluid.stretch_from = {}).",
                             top, settings.text("fluid.stretch_from")),
                 "Use a larger fluid.stretch_from, or fluid.allow_coarse: true.", entries);
}

/// Cyclic sides are as far apart as the two largest grains are wide together: nearer, two grains
/// could touch on both sides.
void check_periods(const Population& population, const Settings& settings, CaseEntries& entries) {
    double first = 0.0, second = 0.0;  // largest radii
    for (const PlacedGrain& grain : population.grains) {
        second = std::max(second, std::min(first, grain.radius));
        first = std::max(first, grain.radius);
    }
    const double least = 2.0 * (first + second);
    const PackingBox box = packing_box(settings);
    const double period =
        std::min(box.periodic_x ? box.width : least, box.periodic_y ? box.height : least);
    if (period >= least) return;
    const CaseEntry* entry = entries.find("domain.size");
    entries.problems.push_back(
        {.source = entry ? entry->source : entries.entries.front().source,
         .line = entry ? entry->line : 0,
         .key = "domain.size",
         .value = settings.text("domain.size"),
         .fault = {},
         .allowed =
             fmt::format("Between cyclic sides lie at least the two largest grains, {:.4g} D: "
                         "with less, two grains could touch on both sides.",
                         least),
         .remedy = "Make the box larger, or use wall or free sides."});
}

/// Properties of a grain that the fluid or the adapter does not support; the first of each kind is
/// named.
void check_abilities(const Population& population, const Settings& settings,
                     const GrainForms& forms, CaseEntries& entries) {
    const GrainsAdapter& adapter = grains_adapter(settings);
    const bool wet = settings.flag("fluid.enabled");
    const Packing& grains = population.grains;
    const auto first = [&](auto&& test) {
        return static_cast<std::size_t>(std::find_if(grains.begin(), grains.end(), test) -
                                        grains.begin());
    };
    if (const auto i = first([&](const PlacedGrain& g) {
            const auto& kind = forms.forms[static_cast<std::size_t>(g.shape)].record.kind;
            return std::find(adapter.shapes.begin(), adapter.shapes.end(), kind) ==
                   adapter.shapes.end();
        });
        i < grains.size() && !population.source.lines.empty())
        refuse_grain(
            population, i, "its shape is not supported by " + adapter.name,
            fmt::format("It supports: {}.", fmt::join(adapter.shapes, ", ")),
            fmt::format("Use one of these, or grains.adapter: {}.",
                        adapters_that([](const GrainsAdapter& a) { return a.shapes.size() > 1; })),
            entries);
    if (const auto i = first([](const PlacedGrain& g) { return g.prescribed; });
        i < grains.size() && !adapter.prescribed_grains)
        refuse_grain(
            population, i, "motion is fixed or driven",
            fmt::format("{} supports free grains only.", adapter.name),
            fmt::format("Use motion = free, or grains.adapter: {}.",
                        adapters_that([](const GrainsAdapter& a) { return a.prescribed_grains; })),
            entries);
    if (const auto i = first([](const PlacedGrain& g) { return !g.motion.empty(); });
        i < grains.size() && !adapter.moved_grains)
        refuse_grain(
            population, i, "motion = " + grains[i].motion,
            fmt::format("In {} no grain follows a motion of domain.motions.", adapter.name),
            fmt::format("Use motion = free, or grains.adapter: {}.",
                        adapters_that([](const GrainsAdapter& a) { return a.moved_grains; })),
            entries);
    const double cells = settings.real("fluid.cells_per_diameter");
    if (const auto i = first([&](const PlacedGrain& g) {
            return 2.0 * g.radius * cells < least_cells_across * (1.0 - 1e-12);
        });
        i < grains.size() && wet)
        refuse_grain(population, i, fmt::format("diameter {:.3g} D", 2.0 * grains[i].radius),
                     fmt::format("A grain in a fluid is at least {:.0f} cells wide, and this one "
                                 "is {:.3g}.",
                                 least_cells_across, 2.0 * grains[i].radius * cells),
                     "Use more fluid.cells_per_diameter or larger grains.", entries);
    if (wet && rows_are_stretched(settings) && is(settings, "fluid.allow_coarse", "false"))
        check_equal_rows(population, settings, entries);
    if (const auto i = first(
            [](const PlacedGrain& g) { return g.density && *g.density <= 1.0 && !g.prescribed; });
        i < grains.size() && wet && settings.text("coupling.scheme") != "joint")
        refuse_grain(population, i, fmt::format("density = {}", *grains[i].density),
                     "Without coupling.scheme: joint, grains in a fluid must be denser than it.",
                     "Use coupling.scheme: joint, or a density above 1.", entries);
}

Population grains_of(const EarlierStart& start, const Settings& settings, const GrainForms& forms) {
    EarlierGrains read =
        read_earlier_grains(start.run, start.earlier, forms, material_names(settings));
    std::vector<std::string> notes{
        fmt::format("grains taken from {} at {:.6g} t_c", read.source, read.time)};
    if (settings.flag("fluid.enabled")) notes.push_back("the fluid starts at rest");
    return {std::move(read.grains), {read.source, {}}, std::move(notes)};
}

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
                 std::max(overlap_of(settings), settings.real("limits.penetration")));
}

void set_materials(Settings& settings) {
    std::string names;
    for (const std::string& name : material_names(settings))
        if (name != "default") names += (names.empty() ? "" : " ") + name;
    settings.set("run.materials", names);
}

// A refused region would only be refused again, grain by grain.
bool region_is_refused(const Settings& settings, const CaseEntries& entries) {
    const CaseEntry* entry = entries.find("grains.region");
    if (entry == nullptr || entry->is_null) return false;
    if (!settings.has("grains.region")) return true;
    const auto region = packing_region(settings);
    const PackingBox box = packing_box(settings);
    return region->width > box.width || region->height > box.height;
}

/// Grains from the given file, else from grains.file, else generated.
Population make_population(Settings& settings, const GrainForms& forms, CaseEntries& entries,
                           const std::filesystem::path& folder, const GivenGrains& given) {
    if (region_is_refused(settings, entries)) return {};
    const bool from_file = given.earlier || !given.file.empty() || settings.has("grains.file");
    // The generator needs a valid count.
    const bool uncounted =
        settings.text("grains.generator") == "random" && !settings.has("grains.count");
    if (!from_file && uncounted) return {};
    Population population =
        given.earlier         ? grains_of(*given.earlier, settings, forms)
        : !given.file.empty() ? grains_from_file(given.file, settings, forms, entries)
        : from_file
            ? grains_from_file(folder / settings.text("grains.file"), settings, forms, entries)
            : generated_grains(settings, forms, entries);
    check_grains(population, settings, forms, entries);
    check_abilities(population, settings, forms, entries);
    check_periods(population, settings, entries);
    if (settings.has("grains.file")) settings.set("grains.file", std::string(copied_grains));
    return population;
}

/// The forms, unless the keys that define them were refused.
std::optional<GrainForms> forms_of(const Settings& settings) {
    const bool polygon = settings.has("grains.shape") && settings.text("grains.shape") == "polygon";
    if (!settings.has("grains.shape") || (polygon && !settings.has("grains.vertices")))
        return std::nullopt;
    if (settings.has("grains.vertices") &&
        !outline_fault(real_list("grains.vertices", settings.text("grains.vertices"))).empty())
        return std::nullopt;
    return make_grain_forms(settings);
}

std::vector<InnerWall> make_walls(Settings& settings, const Packing& grains,
                                  const GrainForms& forms, const std::filesystem::path& folder,
                                  CaseEntries& entries) {
    if (!settings.has("domain.walls_file")) return {};
    const auto file = folder / settings.text("domain.walls_file");
    if (!is_file(file)) {
        entries.problems.push_back(missing_file(entries, "domain.walls_file", file));
        return {};
    }
    InnerWalls read = read_walls_csv(file);
    if (read.problems.empty())
        read.problems =
            check_walls(read.walls, grains, forms, packing_box(settings), file.filename().string(),
                        std::max(overlap_of(settings), touching_tolerance));
    if (settings.flag("fluid.enabled"))
        for (CaseProblem& problem :
             check_thickness(read.walls, file.filename().string(),
                             1.0 / settings.real("fluid.cells_per_diameter")))
            read.problems.push_back(std::move(problem));
    for (CaseProblem& problem : read.problems) entries.problems.push_back(std::move(problem));
    settings.set("domain.walls_file", std::string(copied_walls));
    return std::move(read.walls);
}

/// The text of grains.script. The run folder contains a copy under the same name.
std::string users_script(Settings& settings, const std::filesystem::path& folder,
                         CaseEntries& entries) {
    if (!settings.has("grains.script")) return {};
    const auto file = folder / settings.text("grains.script");
    if (!is_file(file)) {
        entries.problems.push_back(missing_file(entries, "grains.script", file));
        return {};
    }
    settings.set("grains.script", "grains/" + file.filename().string());
    return file_text(file);
}

/// Files in grains.command get absolute paths, with which any program may start it.
void place_command(Settings& settings, const std::filesystem::path& folder) {
    if (!settings.has("grains.command")) return;
    if (const auto words = command_words(settings.text("grains.command")))
        settings.set("grains.command", command_text(with_absolute_files(*words, folder)));
}

Quaternion turned(double angle) {
    if (angle == 0.0) return {1.0, 0.0, 0.0, 0.0};
    return {std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle)};
}

std::vector<GrainState> grain_states(const Packing& grains, const Settings& settings,
                                     const Scales& scales) {
    std::vector<GrainState> states;
    for (const PlacedGrain& grain : grains) {
        GrainState state;
        state.id = grain.id;
        state.shape = grain.shape;
        state.orientation = turned(grain.angle);
        state.radius = grain.radius * scales.diameter;
        state.material = grain.material;
        state.prescribed = grain.prescribed;
        state.density =
            grain.density.value_or(settings.real("grains.density_ratio")) * scales.fluid_density;
        state.velocity = {grain.vx * scales.velocity, grain.vy * scales.velocity, 0.0};
        state.angular_velocity = {0.0, 0.0, grain.spin / scales.time};
        state.position = {grain.x * scales.diameter, grain.y * scales.diameter, 0.0};
        states.push_back(state);
    }
    return states;
}

double height_of(const Packing& grains) {
    double height = 0.0;
    for (const PlacedGrain& grain : grains) height = std::max(height, grain.y + grain.radius);
    return height;
}

/// Replaces coupling.scheme: auto, before anything depends on it.
void choose_scheme(Settings& settings) {
    if (!settings.has("coupling.scheme") || settings.text("coupling.scheme") != "auto") return;
    const bool known = settings.has("grains.adapter") && settings.has("fluid.enabled") &&
                       settings.flag("fluid.enabled");
    const char* scheme = known ? best_scheme(grains_adapter(settings)) : "split";
    settings.set("coupling.scheme", std::string(scheme));
}

/// The coupling scheme, resolved here once for all programs.
void set_scheme(Settings& settings) {
    const SchemeEntry& scheme = find_scheme(scheme_name(settings));
    settings.set("run.scheme", std::string(scheme.name));
    settings.set("run.repeats_windows", scheme.repeats);
    settings.set("run.slip_tolerance", scheme.slip_tolerance(settings));
}

/// The contact parameters and sub-steps of molecular dynamics.
void set_soft_contact(Settings& settings, const Packing& grains) {
    if (grains_adapter(settings).family == "nscd") return;
    const SoftContact contact = soft_contact(settings, height_of(grains));
    settings.set("run.md_frequency", contact.frequency);
    settings.set("run.md_damping", contact.damping);
    settings.set("run.md_substeps", contact.substeps);
}

ResolvedCase finish(Settings settings, Population population, std::vector<InnerWall> walls,
                    std::string script, const GrainForms& forms, const CaseEntries& entries) {
    ResolvedCase result;
    result.script = std::move(script);
    result.scales = make_scales(settings);
    result.grains_csv = population_csv(population.grains, forms, material_names(settings));
    result.walls_csv = walls.empty() ? "" : walls_csv(walls);
    result.yaml = resolved_text(settings, population.grains.size(), result.grains_csv,
                                result.walls_csv, result.script);
    result.notes = std::move(population.notes);
    for (const std::string& note : forms.notes) result.notes.push_back(note);
    for (std::string& note : rule_notes(settings, entries)) result.notes.push_back(std::move(note));
    result.shapes = used_shapes(population.grains, forms);
    result.population = grain_states(population.grains, settings, result.scales);
    set_run_values(settings, result.scales);
    set_scheme(settings);
    settings.set("run.walls",
                 walls_setting(walls, result.scales, settings.real("contact.friction")));
    settings.set("run.wall_motions", motions_setting(settings, walls, result.scales));
    settings.set("run.inflow_motions", inflows_setting(settings, result.scales));
    settings.set("run.grain_motions",
                 grain_motions_setting(settings, population.grains, result.scales));
    set_materials(settings);
    set_soft_contact(settings, population.grains);
    result.packing = std::move(population.grains);
    settings.set("run.hash", case_hash(result.yaml));
    result.settings = std::move(settings);
    return result;
}

/// A check that needs a key is left out if the key was refused.
template <class Check>
void unless_refused(const CaseEntries& entries, Check check) {
    try {
        check();
    } catch (const MissingKey&) {
        if (entries.problems.empty()) throw;
    }
}

ResolvedCase resolve(CaseEntries entries, const std::filesystem::path& folder,
                     const GivenGrains& given_grains) {
    if (entries.entries.empty() && !entries.problems.empty())
        throw CaseRefused(std::move(entries.problems));
    if (given_grains.earlier) name_grains_file(entries);
    Settings settings = check_keys(key_table(), entries);
    choose_scheme(settings);
    check_rules(settings, entries);
    check_materials(settings, entries);
    if (given_grains.earlier) accept_overlaps(settings);
    const std::optional<GrainForms> forms = forms_of(settings);
    if (!forms) throw CaseRefused(std::move(entries.problems));
    Population population;
    unless_refused(entries, [&] {
        population = make_population(settings, *forms, entries, folder, given_grains);
    });
    std::vector<InnerWall> walls;
    unless_refused(
        entries, [&] { walls = make_walls(settings, population.grains, *forms, folder, entries); });
    std::string script = users_script(settings, folder, entries);
    place_command(settings, folder);
    unless_refused(entries, [&] { check_motions(settings, walls, entries); });
    if (!entries.problems.empty()) throw CaseRefused(std::move(entries.problems));
    return finish(std::move(settings), std::move(population), std::move(walls), std::move(script),
                  *forms, entries);
}

EarlierStart earlier_run(const std::string& text) {
    const EarlierRun run = parse_earlier_run(text);
    ResolvedCase resolved = load_run_folder(run.folder);
    std::vector<std::string> materials = material_names(resolved.settings);
    return {run, {resolved.scales, std::move(resolved.shapes), std::move(materials)}};
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
    ResolvedCase result = resolve(read_case_entries(file, overrides), file.parent_path(), given);
    result.name = file.stem().string();
    result.file = std::filesystem::absolute(file).lexically_normal();
    result.overrides = overrides;
    result.from = from;
    return result;
}

ResolvedCase load_run_folder(const std::filesystem::path& folder,
                             const std::vector<std::string>& overrides) {
    const RunFolder paths{folder};
    ResolvedCase result = resolve(read_case_entries(paths.resolved_case(), overrides), folder,
                                  {paths.initial_grains(), {}});
    result.name = std::filesystem::absolute(folder).lexically_normal().filename().string();
    // Every program of the job hashes the file itself, which may have been edited by hand.
    if (overrides.empty())
        result.settings.set("run.hash", case_hash(file_text(paths.resolved_case())));
    return result;
}

}  // namespace turbidite
