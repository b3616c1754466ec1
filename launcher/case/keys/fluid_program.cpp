// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/keys/fluid_program.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "launcher/case/files/command_words.hpp"
#include "launcher/case/forecast/mesh_cost.hpp"

namespace turbidite {
namespace {

constexpr const char* program_of_fluid = "fluid.program";

bool in_the_plane(const Settings& s) {
    return s.has("dimension") && !in_space(s);
}

bool has_functions(const Settings& s) {
    return s.has("fluid.functions");
}

/// What only OpenFOAM can do: the only list of it.
struct Limit {
    const char* key;
    bool (*exceeds)(const Settings&);
    const char* why;
    const char* remedy;
};
constexpr Limit limits_of_box[] = {
    {"dimension", in_the_plane, "it plays boxes in space", "Use dimension: 3"},
    {"fluid.functions", has_functions, "function objects are OpenFOAM's", "Remove it"},
};

/// The first of them that the case needs; null if there is none.
const Limit* obstacle(const Settings& s) {
    const auto* found = std::find_if(std::begin(limits_of_box), std::end(limits_of_box),
                                     [&](const Limit& limit) { return limit.exceeds(s); });
    return found == std::end(limits_of_box) ? nullptr : found;
}

std::string cannot_play(const Limit& limit, const Settings& s) {
    return fmt::format("cannot play a case with {} = {}: {}", limit.key, s.text(limit.key),
                       limit.why);
}

Ruling box_can_play(const Settings& s) {
    if (!s.flag("fluid.enabled") || fluid_program(s) != FluidProgram::box) return std::nullopt;
    const Limit* limit = obstacle(s);
    if (!limit) return std::nullopt;
    return Objection{fmt::format("The box program {}.", cannot_play(*limit, s)),
                     fmt::format("{}, or fluid.program: openfoam.", limit->remedy)};
}

bool has_all(const Settings& s, const std::vector<const char*>& keys) {
    return std::all_of(keys.begin(), keys.end(), [&](const char* name) { return s.has(name); });
}

/// Of the program, in memory and number of cells.
bool fits(const Settings& s, FluidProgram program) {
    return fluid_cells(s) <= most_cells && fluid_memory(s, program) <= memory_limit(s);
}

bool known_not_to_fit(const Settings& s, FluidProgram program) {
    return has_all(s, keys_of_memory()) && !fits(s, program);
}

/// Why OpenFOAM cannot play the case here; empty if it can.
std::string lack_of_openfoam(const Settings& s) {
    if (find_program_file("blockMesh").empty())
        return "OpenFOAM is not installed (there is no blockMesh in PATH)";
    if (!known_not_to_fit(s, FluidProgram::openfoam)) return "";
    return fmt::format("OpenFOAM would take about {:.3g} GB of memory, and there are {:.3g} GB{}",
                       fluid_memory(s, FluidProgram::openfoam), memory_limit(s),
                       s.has("limits.memory") ? " (limits.memory)" : "");
}

}  // namespace

KeySpec program_key() {
    return {.name = program_of_fluid,
            .type = KeyType::choice,
            .fallback = "auto",
            .choices = {{"auto",
                         "openfoam; box where OpenFOAM is not installed, or its mesh does "
                         "not fit into memory, and the case is one that box can play"},
                        {program_name(FluidProgram::openfoam),
                         "OpenFOAM, whose files and utilities the fluid then has"},
                        {program_name(FluidProgram::box),
                         "the same steps in plain arrays, for spheres in a box: without OpenFOAM, "
                         "in less memory (docs/box-program.md)"}},
            .help = "the program that plays the fluid",
            .idle = [](const Settings& s) {
                return std::string(s.flag("fluid.enabled") ? "" : "without a fluid");
            }};
}

std::vector<Rule> program_rules() {
    return {{program_of_fluid, {"fluid.enabled", "dimension"}, box_can_play}};
}

std::string choose_program(Settings& settings) {
    if (!is(settings, program_of_fluid, "auto")) return "";
    settings.set(program_of_fluid, std::string(program_name(FluidProgram::openfoam)));
    if (!is(settings, "fluid.enabled", "true")) return "";
    const std::string lack = lack_of_openfoam(settings);
    if (lack.empty()) return "";
    if (const Limit* limit = obstacle(settings))
        return fmt::format("{}; fluid.program: box {}", lack, cannot_play(*limit, settings));
    if (known_not_to_fit(settings, FluidProgram::box)) return lack;
    settings.set(program_of_fluid, std::string(program_name(FluidProgram::box)));
    return fmt::format("{}: fluid.program: auto is box here", lack);
}

std::string hint_of_box(const Settings& s) {
    if (!in_space(s) || fluid_program(s) == FluidProgram::box) return "";
    if (const Limit* limit = obstacle(s)) return "fluid.program: box " + cannot_play(*limit, s);
    return fmt::format("fluid.program: box would take about {:.3g} GB",
                       fluid_memory(s, FluidProgram::box));
}

}  // namespace turbidite
