// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/forecast/disk_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "coupler/keys/key_spec.hpp"
#include "coupler/keys/key_value.hpp"
#include "coupler/protocol/run_values.hpp"
#include "coupler/protocol/scene/splitting.hpp"
#include "launcher/case/forecast/gigabyte.hpp"
#include "launcher/case/forecast/mesh_cost.hpp"
#include "launcher/case/forecast/run_cost.hpp"
#include "launcher/case/slices.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

// Bytes per cell. OpenFOAM writes numbers of 8 bytes and labels of 4.
constexpr double of_mesh = 150.0;
constexpr double of_shared_mesh = 180.0;  // the same again in processor*, with addressing
constexpr double of_field_set = 56.0;     // velocity and multipliers 24 each, pressure 8
constexpr double of_scalar_field = 8.0, of_vector_field = 24.0;
constexpr double of_box_field_set = 16.0;  // velocity and pressure of the box program, 4 bytes each
constexpr double of_slice = 20.0;          // p, U and covered, 4 bytes each

// In checkpoints velocity and pressure have 8 bytes per number, too, and OpenFOAM's velocity three
// numbers in the plane.
constexpr double of_velocity_and_pressure = 32.0;
constexpr double of_number = 8.0, of_label = 4.0;

// Bytes per grain: of one output (grains and contacts, base64), of one checkpoint.
constexpr double of_disc = 430.0, of_polygon = 700.0, of_sphere = 900.0;
constexpr double of_grain_checkpoint = 900.0;

constexpr double of_history_row = 550.0;

double words(const std::string& text) {
    std::istringstream input(text);
    double count = 0.0;
    for (std::string word; input >> word;) ++count;
    return count;
}

double bytes_of_mesh(const Settings& settings) {
    if (fluid_program(settings) == FluidProgram::box) return 0.0;
    return of_mesh + (settings.integer("fluid.ranks") > 1 ? of_shared_mesh : 0.0);
}

double bytes_of_fields(const Settings& settings) {
    const std::string more = settings.has("output.fields") ? settings.text("output.fields") : "";
    const bool vectors = in_space(settings) && more.find("vorticity") != std::string::npos;
    const double more_bytes =
        of_scalar_field * words(more) + (vectors ? of_vector_field - of_scalar_field : 0.0);
    // The box program writes 4 bytes where OpenFOAM writes 8.
    if (fluid_program(settings) == FluidProgram::box) return of_box_field_set + 0.5 * more_bytes;
    return of_field_set + more_bytes;
}

/// Of one set: velocity and pressure, and what steps remember (BoxFluidStep::visit_memory), which
/// is the flux beside the velocity's; in second order the last flux and the carried velocity, too;
/// with rigid grains in pressure the pressure itself.
double bytes_of_checkpoint(const Settings& settings) {
    const double vector = of_number * (in_space(settings) ? 3.0 : 2.0);
    const bool second_order = settings.text("fluid.time_scheme") == "second-order";
    const bool labels = fluid_program(settings) == FluidProgram::openfoam;
    return of_velocity_and_pressure + (labels ? of_label : 0.0) +
           vector * (second_order ? 3.0 : 1.0) +
           (splitting_of(settings).rigid_grains ? of_number : 0.0);
}

/// Of one output.
double bytes_of_slices(const Settings& settings) {
    const std::vector<double> size = real_list("domain.size", settings.text("domain.size"));
    const auto per_diameter = static_cast<double>(settings.integer("fluid.cells_per_diameter"));
    double cells = 0.0;
    for (const SlicePlane& plane : slices_of(settings))
        // All cells over the number of equal ones along the plane's normal.
        cells += fluid_cells(settings) / (size.at(plane.axis) * per_diameter);
    return of_slice * cells;
}

/// Those of every so many windows, and of the last one.
double outputs(std::int64_t windows, std::int64_t every) {
    // Rounded up: the last window is written whether its turn has come or not.
    return static_cast<double>((windows + every - 1) / every);
}

/// Sets that are kept.
double checkpoints(const ResolvedCase& resolved) {
    const Settings& settings = resolved.settings;
    const auto windows = static_cast<double>(settings.integer("run.windows"));
    const double minutes = predicted_seconds(resolved) / 60.0;
    const auto sets = [](double whole, double every) { return every > 0.0 ? whole / every : 0.0; };
    const double all = sets(settings.real("time.end"), settings.real("checkpoint.interval")) +
                       sets(windows, static_cast<double>(settings.integer("checkpoint.windows"))) +
                       sets(minutes, settings.real("checkpoint.wall_minutes"));
    // And those of t = 0 and of the end.
    const double written = all > 0.0 ? 1.0 + std::ceil(all) : 0.0;
    return std::min(written, static_cast<double>(settings.integer("checkpoint.keep")));
}

double fluid_bytes(const Settings& settings, const RunValues& run, double sets) {
    const double per_cell = bytes_of_mesh(settings) +
                            bytes_of_fields(settings) * outputs(run.windows, run.fields_every) +
                            bytes_of_checkpoint(settings) * sets;
    return per_cell * fluid_cells(settings) +
           bytes_of_slices(settings) * outputs(run.windows, run.output_every);
}

double grain_bytes(const ResolvedCase& resolved, const RunValues& run, double sets) {
    const double planar = all_round(resolved) ? of_disc : of_polygon;
    const double per_grain =
        // One more output than turns: that of t = 0.
        (run.dimension == 3 ? of_sphere : planar) * (1.0 + outputs(run.windows, run.output_every)) +
        of_grain_checkpoint * sets;
    return per_grain * static_cast<double>(resolved.population.size());
}

/// The folder itself, or the nearest one above it that exists.
fs::path existing_folder(fs::path path) {
    std::error_code error;
    path = fs::absolute(path);
    while (!fs::exists(path, error) && path.has_relative_path()) path = path.parent_path();
    return path;
}

}  // namespace

double predicted_disk(const ResolvedCase& resolved) {
    const RunValues run = run_values(resolved.settings);
    const double history = of_history_row * (1.0 + outputs(run.windows, run.output_every));
    const double sets = checkpoints(resolved);
    const double fluid = run.wet ? fluid_bytes(resolved.settings, run, sets) : 0.0;
    return (fluid + grain_bytes(resolved, run, sets) + history) / gigabyte;
}

std::string rough_size(double gigabytes) {
    if (gigabytes < 1.0) return fmt::format("{:.0f} MB", std::max(1.0, 1e3 * gigabytes));
    return fmt::format("{:.{}f} GB", gigabytes, gigabytes < 10.0 ? 1 : 0);
}

std::string lack_of_disk(double gigabytes, const fs::path& folder) {
    std::error_code error;
    const fs::path where = existing_folder(folder);
    const auto space = fs::space(where, error);
    if (error) return "";
    const double available = static_cast<double>(space.available) / gigabyte;
    if (gigabytes <= available) return "";
    return fmt::format(
        "roughly {} of files are to come, {} are free in {}. A longer output.fields_interval, "
        "checkpoint.keep=1 or another --out help.",
        rough_size(gigabytes), rough_size(available), where.string());
}

}  // namespace turbidite
