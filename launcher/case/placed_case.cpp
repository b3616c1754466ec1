// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/placed_case.hpp"

#include <algorithm>
#include <utility>

#include "coupler/keys/key_spec.hpp"
#include "coupler/keys/key_value.hpp"
#include "coupler/protocol/files/whole_file.hpp"
#include "launcher/case/files/file_names.hpp"
#include "launcher/case/grains/grain_abilities.hpp"
#include "launcher/case/grains/materials.hpp"
#include "launcher/case/grains/packing/pouring.hpp"
#include "launcher/case/walls/space_walls.hpp"
#include "launcher/case/walls/wall_motion.hpp"

namespace turbidite {
namespace {

constexpr auto copied_walls = "grains/walls.csv";
constexpr auto copied_functions = "fluid/system/functions";

std::filesystem::path copied_script(const std::string& script) {
    return std::filesystem::path("grains") / std::filesystem::path(script).filename();
}

/// What `make` returns, or nothing if it needs a key that was refused.
template <class Make>
auto unless_refused(bool faults, Make make) -> decltype(make()) {
    try {
        return make();
    } catch (const MissingKey&) {
        if (!faults) throw;
        return {};
    }
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

InnerWalls walls_of(const Settings& settings, const CaseEntries& entries, const Packing& grains,
                    const GrainForms& forms, const std::filesystem::path& folder) {
    if (!settings.has("domain.walls_file")) return {};
    const auto file = folder / settings.text("domain.walls_file");
    if (!is_file(file)) return {{}, {missing_file(entries, "domain.walls_file", file)}};
    InnerWalls read = in_space(settings) ? read_space_walls_csv(file, material_names(settings))
                                         : read_walls_csv(file);
    const std::string name = file.filename().string();
    if (read.problems.empty())
        read.problems = check_walls(read.walls, grains, forms, packing_box(settings), name,
                                    std::max(settings.real("grains.overlap"), touching_tolerance));
    if (settings.flag("fluid.enabled"))
        append(read.problems, check_thickness(read.walls, name, settings));
    return read;
}

/// A dry case has none to keep.
bool has_functions(const Settings& settings) {
    return settings.has("fluid.functions") && is(settings, "fluid.enabled", "true");
}

void place_functions(const Settings& settings, const CaseEntries& entries,
                     const std::filesystem::path& folder, PlacedCase& placed) {
    const auto file = folder / settings.text("fluid.functions");
    if (can_be_read(file))
        placed.functions = read_function_objects(file);
    else
        placed.problems.push_back(missing_file(entries, "fluid.functions", file));
    append(placed.problems, placed.functions.problems);
}

}  // namespace

PlacedCase place(const Settings& settings, const CaseEntries& entries,
                 const std::filesystem::path& folder, const GivenGrains& given, bool faults) {
    PlacedCase placed;
    placed.forms = forms_of(settings);
    if (!placed.forms) return placed;
    const GrainForms& forms = *placed.forms;
    const auto check = [&](auto&& problems_of) {
        const bool more = faults || !placed.problems.empty();
        append(placed.problems, unless_refused(more, problems_of));
    };
    placed.start = unless_refused(
        faults, [&] { return start_grains(settings, entries, forms, folder, given); });
    const StartGrains& start = placed.start;
    append(placed.problems, std::move(placed.start.problems));
    check([&] {
        return check_population(start.grains, start.source, packing_box(settings),
                                solid_sides(settings), forms, settings.real("grains.overlap"));
    });
    check([&] {
        if (!is_poured(settings)) return check_abilities(start, settings, forms);
        StartGrains poured = start;
        take_poured_radii(poured.grains, settings);
        return check_abilities(poured, settings, forms);
    });
    check([&] { return check_periods(start.grains, settings, entries); });
    check([&] {
        // Poured grains will be elsewhere than what stands in for them.
        const Packing none;
        InnerWalls read =
            walls_of(settings, entries, is_poured(settings) ? none : start.grains, forms, folder);
        placed.walls = std::move(read.walls);
        return std::move(read.problems);
    });
    if (settings.has("grains.script")) {
        const auto file = folder / settings.text("grains.script");
        if (can_be_read(file))
            placed.script = read_whole(file);
        else
            placed.problems.push_back(missing_file(entries, "grains.script", file));
    }
    if (has_functions(settings)) place_functions(settings, entries, folder, placed);
    check([&] { return check_motions(settings, placed.walls, entries); });
    return placed;
}

bool names_copy(const std::string& key) {
    return key == "grains.file" || key == "domain.walls_file" || key == "grains.script" ||
           key == "fluid.functions";
}

void name_copies(Settings& settings) {
    if (settings.has("grains.file")) settings.set("grains.file", std::string(copied_grains));
    if (settings.has("domain.walls_file"))
        settings.set("domain.walls_file", std::string(copied_walls));
    if (settings.has("grains.script"))
        settings.set("grains.script", copied_script(settings.text("grains.script")).string());
    if (has_functions(settings)) settings.set("fluid.functions", std::string(copied_functions));
}

}  // namespace turbidite
