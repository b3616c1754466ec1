// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/forecast/mesh_cost.hpp"

#include <unistd.h>

#include "coupler/keys/key_spec.hpp"
#include "coupler/keys/key_value.hpp"
#include "coupler/protocol/scene/mesh_rows.hpp"
#include "coupler/protocol/scene/splitting.hpp"
#include "launcher/case/forecast/gigabyte.hpp"

namespace turbidite {
namespace {

/// Bytes per cell, but for the last.
struct ProgramMemory {
    double plain;
    double second_order;   ///< velocities and fluxes of the stages
    double rigid_grains;   ///< pressure and viscosity with them
    double several_ranks;  ///< columns of p and u beside rows
    double without_cells;
};
constexpr ProgramMemory of_openfoam{750.0, 80.0, 190.0, 0.0, 1e8};
// 24 of second order are the beginning of a part of the window, where transport is cut into parts:
// whether it will be is not known before the run.
constexpr ProgramMemory of_box{95.0, 119.0, 75.0, 35.0, 5e7};
/// Faces in wedges between spheres, where a dense packing fills the box.
constexpr double of_wedges = 25.0;

}  // namespace

double fluid_rows(const Settings& settings) {
    const double top = real_list("domain.size", settings.text("domain.size")).at(1);
    // Not rounded: a forecast, and no mesh yet.
    const double equal = top * settings.real("fluid.cells_per_diameter");
    if (!rows_are_stretched(settings)) return equal;
    const auto rows = mesh_rows(settings, top);
    return rows ? rows->count() : equal;
}

double fluid_cells(const Settings& settings) {
    const auto size = real_list("domain.size", settings.text("domain.size"));
    const double across = settings.real("fluid.cells_per_diameter");
    const double layer = size.at(0) * across * (in_space(settings) ? size.at(2) * across : 1.0);
    // Only rows are stretched; columns, and layers of space, are equal.
    return layer * fluid_rows(settings);
}

const char* program_name(FluidProgram program) {
    return program == FluidProgram::box ? "box" : "openfoam";
}

FluidProgram fluid_program(const Settings& settings) {
    const bool box = is(settings, "fluid.program", program_name(FluidProgram::box));
    return box ? FluidProgram::box : FluidProgram::openfoam;
}

bool has_openfoam(const Settings& settings) {
    return settings.flag("fluid.enabled") && fluid_program(settings) == FluidProgram::openfoam;
}

double fluid_memory(const Settings& settings, FluidProgram program) {
    const ProgramMemory& bytes = program == FluidProgram::box ? of_box : of_openfoam;
    const bool second_order = settings.text("fluid.time_scheme") == "second-order";
    const bool rigid_grains = splitting_of(settings).rigid_grains;
    const double per_cell = bytes.plain + (second_order ? bytes.second_order : 0.0) +
                            (rigid_grains ? bytes.rigid_grains : 0.0) +
                            (settings.integer("fluid.ranks") > 1 ? bytes.several_ranks : 0.0) +
                            (rigid_grains && in_space(settings) ? of_wedges : 0.0);
    return (bytes.without_cells + per_cell * fluid_cells(settings)) / gigabyte;
}

double fluid_memory(const Settings& settings) {
    return fluid_memory(settings, fluid_program(settings));
}

const std::vector<const char*>& keys_of_memory() {
    static const std::vector<const char*> keys = {
        "fluid.enabled",        "fluid.ranks",     "dimension",   "fluid.cells_per_diameter",
        "fluid.time_scheme",    "fluid.splitting", "domain.size", "fluid.stretch_ratio",
        "fluid.stretch_largest"};
    return keys;
}

double memory_limit(const Settings& settings) {
    if (settings.has("limits.memory")) return settings.real("limits.memory");
    const double pages = static_cast<double>(::sysconf(_SC_PHYS_PAGES));
    return pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) / gigabyte;
}

}  // namespace turbidite
