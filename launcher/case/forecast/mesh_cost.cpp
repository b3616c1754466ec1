// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/forecast/mesh_cost.hpp"

#include <unistd.h>

#include "coupler/keys/key_spec.hpp"
#include "coupler/keys/key_value.hpp"
#include "coupler/protocol/mesh_rows.hpp"
#include "coupler/protocol/splitting.hpp"

namespace turbidite {
namespace {

constexpr double bytes_per_cell = 750.0;
constexpr double bytes_of_second_order = 80.0;   // per cell, velocities and fluxes of the stages
constexpr double bytes_of_rigid_grains = 190.0;  // per cell, pressure and viscosity with them
constexpr double bytes_without_cells = 1e8;
constexpr double gigabyte = 1e9;

}  // namespace

double fluid_rows(const Settings& settings) {
    const double top = real_list("domain.size", settings.text("domain.size")).at(1);
    const double equal = top * settings.real("fluid.cells_per_diameter");
    if (!rows_are_stretched(settings)) return equal;
    const auto rows = mesh_rows(settings, top);
    return rows ? rows->count() : equal;
}

double fluid_cells(const Settings& settings) {
    const auto size = real_list("domain.size", settings.text("domain.size"));
    const double across = settings.real("fluid.cells_per_diameter");
    const double layer = size.at(0) * across * (in_space(settings) ? size.at(2) * across : 1.0);
    return layer * fluid_rows(settings);
}

double fluid_memory(const Settings& settings) {
    const bool second_order = settings.text("fluid.time_scheme") == "second-order";
    const bool rigid_grains = splitting_of(settings).rigid_grains;
    const double per_cell = bytes_per_cell + (second_order ? bytes_of_second_order : 0.0) +
                            (rigid_grains ? bytes_of_rigid_grains : 0.0);
    return (bytes_without_cells + per_cell * fluid_cells(settings)) / gigabyte;
}

double memory_limit(const Settings& settings) {
    if (settings.has("limits.memory")) return settings.real("limits.memory");
    const double pages = static_cast<double>(::sysconf(_SC_PHYS_PAGES));
    return pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) / gigabyte;
}

}  // namespace turbidite
