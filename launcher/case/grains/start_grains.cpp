// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/start_grains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "coupler/keys/key_value.hpp"
#include "coupler/protocol/scene/sides.hpp"
#include "launcher/case/case_rules.hpp"
#include "launcher/case/files/file_names.hpp"
#include "launcher/case/grains/materials.hpp"
#include "launcher/case/walls/wall_motion.hpp"

namespace turbidite {
namespace {

/// Ends of the axis and radius.
PackingRegion cylinder_region(const std::vector<double>& n) {
    return enclosing({{n.at(0), n.at(1), n.at(2)}, {n.at(3), n.at(4), n.at(5)}, n.at(6)});
}

std::optional<PackingRegion> packing_region(const Settings& settings) {
    if (settings.has("grains.cylinder"))
        return cylinder_region(real_list("grains.cylinder", settings.text("grains.cylinder")));
    if (!settings.has("grains.region")) return std::nullopt;
    const auto size = real_list("grains.region", settings.text("grains.region"));
    return PackingRegion{size.at(0), size.at(1), size.size() > 2 ? size[2] : 0.0};
}

/// None in space unless there is a lattice.
double compacity_of(const Settings& settings) {
    const bool missing = in_space(settings) && !settings.has("grains.compacity");
    return missing ? 0.0 : settings.real("grains.compacity");
}

PackingRequest packing_request(const Settings& settings, const GrainForms& forms) {
    const bool counted = settings.has("grains.count");
    const bool lattice = settings.has("grains.lattice");
    return {.box = packing_box(settings),
            .region = packing_region(settings),
            .compacity = compacity_of(settings),
            .count = counted ? settings.integer("grains.count") : 0,
            .jitter = settings.real("grains.jitter"),
            .seed = static_cast<std::uint64_t>(settings.integer("random.seed")),
            .forms = &forms,
            .size_ratio = settings.real("grains.size_ratio"),
            .lattice = lattice ? settings.text("grains.lattice") : ""};
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

StartGrains generated_grains(const Settings& settings, const CaseEntries& entries,
                             const GrainForms& forms) {
    const PackingRequest request = packing_request(settings, forms);
    const GeneratorEntry& entry = generator(settings.text("grains.generator"));
    PackingResult result =
        request.box.in_space() ? entry.make_in_space(request) : entry.make(request);
    StartGrains start{std::move(result.grains),
                      {entries.entries.front().source, {}},
                      std::move(result.notes),
                      {}};
    if (!result.refusal.empty())
        start.problems.push_back(
            problem_with(blamed_key(settings), {result.refusal, {}}, settings, entries));
    return start;
}

StartGrains grains_from_file(const std::filesystem::path& file, const Settings& settings,
                             const CaseEntries& entries, const GrainForms& forms,
                             const char* key = "grains.file") {
    if (!is_file(file)) return {{}, {}, {}, {missing_file(entries, key, file)}};
    PopulationFile read =
        read_population_csv(file, forms, material_names(settings), motion_names(settings));
    return {std::move(read.grains), std::move(read.source), {}, std::move(read.problems)};
}

StartGrains extra_grains(const std::filesystem::path& file, const Settings& settings,
                         const CaseEntries& entries, const GrainForms& forms) {
    return grains_from_file(file, settings, entries, forms, "grains.extra_file");
}

void add(StartGrains& start, StartGrains more) {
    start.notes.push_back(
        fmt::format("{} grains more from {}", more.grains.size(), more.source.name));
    start.grains.insert(start.grains.end(), more.grains.begin(), more.grains.end());
    append(start.problems, std::move(more.problems));
}

/// Its centre is beyond a free side, where an output shows it until no part of it is inside.
bool is_leaving(const PlacedGrain& grain, const PackingBox& box, const Settings& settings) {
    const Vec3 place{grain.x, grain.y, grain.z}, size{box.width, box.height, box.depth};
    return std::any_of(box_sides.begin(), box_sides.end(), [&](const BoxSide& side) {
        return is(settings, side.key, "free") && side.distance(place, size) < 0.0;
    });
}

/// Positions of outside programs may run on across cyclic sides.
void wrap(PlacedGrain& grain, const PackingBox& box, const Settings& settings) {
    double* const place[] = {&grain.x, &grain.y, &grain.z};
    const double length[] = {box.width, box.height, box.depth};
    for (const BoxSide& side : box_sides)
        if (side.inward > 0.0 && is(settings, side.key, "cyclic"))
            *place[side.axis] -=
                length[side.axis] * std::floor(*place[side.axis] / length[side.axis]);
}

/// From sqrt(g D), of a pouring, to u_c; spins from sqrt(g/D) to 1/t_c have the same factor.
void convert_rates(Packing& grains, const Scales& scales) {
    const double factor = std::sqrt(scales.gravity * scales.diameter) / scales.velocity;
    for (PlacedGrain& grain : grains)
        for (double* rate : {&grain.vx, &grain.vy, &grain.vz, &grain.wx, &grain.wy, &grain.spin})
            *rate *= factor;
}

/// "the grains keep density 2.5 of the earlier run; grains.density_ratio = 8 counts for scales and
/// forecasts alone"; empty where they have what the key says.
std::string keeps(const Packing& grains, const Settings& settings, const char* key,
                  const char* what, double (*value)(const PlacedGrain&)) {
    if (!settings.has(key)) return "";
    const auto [least, most] =
        std::minmax_element(grains.begin(), grains.end(),
                            [&](const auto& a, const auto& b) { return value(a) < value(b); });
    const double asked = settings.real(key), low = value(*least), high = value(*most);
    const double same = 1e-6 * asked;  // the series has nine digits
    if (low <= asked + same && high >= asked - same) return "";
    const std::string range = high - low <= same ? fmt::format("{:.6g}", low)
                                                 : fmt::format("{:.6g} to {:.6g}", low, high);
    return fmt::format(
        "the grains keep the {} of the earlier run, {}; {} = {} counts for scales and forecasts "
        "alone",
        what, range, key, settings.text(key));
}

StartGrains grains_of(const EarlierStart& start, const Settings& settings,
                      const GrainForms& forms) {
    EarlierGrains read =
        read_earlier_grains(start.run, start.earlier, forms, material_names(settings));
    if (start.poured) convert_rates(read.grains, make_scales(settings));
    std::vector<std::string> notes{
        fmt::format("grains taken from {} at {:.6g} t_c", read.source, read.time)};
    const PackingBox box = packing_box(settings);
    for (PlacedGrain& grain : read.grains) wrap(grain, box, settings);
    const auto left = std::erase_if(
        read.grains, [&](const PlacedGrain& grain) { return is_leaving(grain, box, settings); });
    if (read.grains.empty())
        throw start_refused(read.source + " holds no grain inside the box",
                            "Give an earlier output, DIR@TIME with the time in t_c.");
    if (left > 0)
        notes.push_back(fmt::format("{} of them, which were beyond a free side, left out", left));
    for (const std::string& note :
         {keeps(read.grains, settings, "grains.density_ratio", "density ratio",
                [](const PlacedGrain& grain) { return *grain.density; }),
          keeps(read.grains, settings, "grains.radius", "radius",
                [](const PlacedGrain& grain) { return grain.radius; })})
        if (!note.empty() && !start.poured) notes.push_back(note);
    if (settings.flag("fluid.enabled")) notes.push_back("the fluid starts at rest");
    return {std::move(read.grains), {read.source, {}}, std::move(notes), {}};
}

// A refused region would only be refused again, grain by grain.
bool region_is_refused(const Settings& settings, const CaseEntries& entries) {
    const CaseEntry* entry = entries.find("grains.region");
    if (entry == nullptr || entry->is_null) return false;
    if (!settings.has("grains.region")) return true;
    const auto region = packing_region(settings);
    const PackingBox box = packing_box(settings);
    return region->width > box.width || region->height > box.height || region->depth > box.depth;
}

/// A cylinder without an axis, or one that is not read.
bool cylinder_is_refused(const Settings& settings, const CaseEntries& entries) {
    const CaseEntry* entry = entries.find("grains.cylinder");
    if (entry == nullptr || entry->is_null) return false;
    if (!settings.has("grains.cylinder")) return true;
    return !is_in_box(real_list("grains.cylinder", settings.text("grains.cylinder")),
                      packing_box(settings));
}

/// Whether the keys that describe the grains were all accepted: a generator needs a count.
bool are_described(const Settings& settings, const CaseEntries& entries, const GivenGrains& given) {
    if (region_is_refused(settings, entries) || cylinder_is_refused(settings, entries))
        return false;
    if (given.earlier || !given.file.empty() || settings.has("grains.file")) return true;
    if (settings.text("grains.generator") != "lattice") return settings.has("grains.count");
    return !in_space(settings) || settings.has("grains.compacity");
}

}  // namespace

PackingBox packing_box(const Settings& settings) {
    const auto size = real_list("domain.size", settings.text("domain.size"));
    return {.width = size.at(0),
            .height = size.at(1),
            .periodic_x = settings.text("domain.left") == "cyclic",
            .periodic_y = settings.text("domain.bottom") == "cyclic",
            .depth = size.size() > 2 ? size[2] : 0.0,
            .periodic_z = is(settings, "domain.front", "cyclic")};
}

SolidSides solid_sides(const Settings& settings) {
    SolidSides sides;
    const std::size_t count = side_count(in_space(settings) ? 3 : 2);
    for (std::size_t i = 0; i < count; ++i)
        // Walls, and inflows, which are walls for grains.
        sides.solid[i] = holds_grains(settings.text(box_sides[i].key));
    return sides;
}

bool is_in_box(const std::vector<double>& n, const PackingBox& box) {
    if (n.size() != 7 || !(n[6] > 0.0)) return false;
    if (n[0] == n[3] && n[1] == n[4] && n[2] == n[5]) return false;
    const PackingRegion region = cylinder_region(n);
    const Vec3 high = region.corner + Vec3{region.width, region.height, region.depth};
    const Vec3 size{box.width, box.height, box.depth};
    for (std::size_t i = 0; i < 3; ++i)
        if (region.corner[i] < -fit_rounding || high[i] > size[i] + fit_rounding) return false;
    return true;
}

CaseProblem missing_file(const CaseEntries& entries, const std::string& key,
                         const std::filesystem::path& file) {
    const CaseEntry* entry = entries.find(key);
    const std::string name = file.lexically_normal().string();
    const bool unreadable = is_file(file);
    return {.source = entry ? entry->source : file.string(),
            .line = entry ? entry->line : 0,
            .key = key,
            .value = entry ? entry->value : file.filename().string(),
            .fault = {},
            .allowed = unreadable ? "The file " + name + " cannot be read by this user."
                                  : "There is no file " + name + ".",
            .remedy = unreadable ? "Change its permissions."
                                 : "Paths are relative to the folder of the case file."};
}

StartGrains start_grains(const Settings& settings, const CaseEntries& entries,
                         const GrainForms& forms, const std::filesystem::path& folder,
                         const GivenGrains& given) {
    if (!are_described(settings, entries, given)) return {};
    // The run folder's own file has everything, those of the extra file too.
    if (!given.file.empty()) return grains_from_file(given.file, settings, entries, forms);
    StartGrains start;
    if (given.earlier)
        start = grains_of(*given.earlier, settings, forms);
    else if (settings.has("grains.file"))
        // A file of the user's has all grains; extra ones are for generators and earlier runs.
        return grains_from_file(folder / settings.text("grains.file"), settings, entries, forms);
    else
        start = generated_grains(settings, entries, forms);
    if (settings.has("grains.extra_file"))
        add(start,
            extra_grains(folder / settings.text("grains.extra_file"), settings, entries, forms));
    return start;
}

}  // namespace turbidite
