// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/forecast/run_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>
#include <thread>
#include <vector>

#include "coupler/hub/schemes/scheme.hpp"
#include "coupler/keys/key_spec.hpp"
#include "coupler/protocol/scene/splitting.hpp"
#include "coupler/shapes/shape.hpp"
#include "launcher/case/forecast/gigabyte.hpp"
#include "launcher/case/forecast/mesh_cost.hpp"
#include "launcher/case/grains/grains_adapters.hpp"

namespace turbidite {
namespace {

/// Seconds per window and cell of the mesh, and per cell that a grain covers: there are the points
/// of the multipliers.
struct FluidRates {
    double cell, covered;
};
constexpr FluidRates paper_splitting{50e-9, 280e-9};
constexpr FluidRates explicit_splitting{85e-9, 380e-9};
constexpr FluidRates implicit_splitting{300e-9, 1500e-9};
// In space: closed form, no points on surfaces.
constexpr FluidRates paper_splitting_in_space{80e-9, 40e-9};
constexpr FluidRates explicit_splitting_in_space{120e-9, 60e-9};
constexpr FluidRates implicit_splitting_in_space{450e-9, 225e-9};
constexpr double second_order = 1.3;   // of the cells
constexpr double busiest_share = 1.6;  // of the covered cells, over an equal one: grains settle

// Where all fluid ranks of a window meet, and how long one waits for its turn on a core that it
// shares [s]. Measured as 3 to 16 ranks on two cores, to a factor of two.
constexpr double meetings = 100.0;
constexpr double time_slice = 0.1e-3;

// Seconds per window and grain.
constexpr double disc_contacts = 4e-6;
constexpr double polygon_contacts = 12e-6;
constexpr double sphere_contacts = 8e-6;  // 18,720 of them in mid-collapse
constexpr double external_code = 20e-6;   // nothing is known of it
constexpr double spring_step = 0.4e-6;    // and per sub-step
constexpr double checks = 1.5e-6;         // of the coupler

// Spheres from which several ranks of the contact engine pay.
constexpr double grains_for_ranks = 5000.0;

constexpr double handover = 0.15e-3;  // [s] from program to program of one host, asleep on arrival

constexpr double seconds_to_start = 0.5;
constexpr double seconds_of_yade = 1.5;
// Of OpenFOAM's program only: the box program makes no mesh.
constexpr double seconds_per_cell = 6e-6;  // blockMesh, and reading its mesh

// Bytes.
constexpr double of_coupler = 2e7, of_coupler_per_grain = 2800.0;
constexpr double of_coupler_per_sphere = 5000.0;  // with the voxels of its pores
constexpr double of_yade = 2.5e8, of_other_hosts = 3e7, of_host_per_grain = 5000.0;

double count(const ResolvedCase& resolved) {
    return static_cast<double>(resolved.population.size());
}

const SchemeEntry& scheme_of(const ResolvedCase& resolved) {
    return find_scheme(resolved.settings.text("run.scheme"));
}

/// Rounds of contacts and fluid in one window.
double rounds(const ResolvedCase& resolved) {
    const SchemeEntry& scheme = scheme_of(resolved);
    // A single grain has the exact inertia under `joint`, so that one round is enough.
    return scheme.repeats || resolved.population.size() > 1 ? scheme.usual_rounds : 1.0;
}

/// Solid area over that of a cell; in space volumes.
double covered_cells(const ResolvedCase& resolved) {
    std::vector<std::shared_ptr<const Shape>> shapes;
    for (const ShapeRecord& shape : resolved.shapes) shapes.push_back(make_shape(shape));
    double area = 0.0;
    for (const GrainState& grain : resolved.population)
        area += shapes.at(grain.shape)->volume(grain.radius);
    const double cell =
        resolved.scales.diameter / resolved.settings.real("fluid.cells_per_diameter");
    // Cells of edge h = D / cells_per_diameter, also where rows are stretched: grains stay below.
    return area / (cell * cell * (in_space(resolved.settings) ? cell : 1.0));
}

FluidRates rates(const Settings& settings) {
    const Splitting& splitting = splitting_of(settings);
    const bool space = in_space(settings);
    if (!splitting.rigid_grains) return space ? paper_splitting_in_space : paper_splitting;
    if (splitting.iterated) return space ? implicit_splitting_in_space : implicit_splitting;
    return space ? explicit_splitting_in_space : explicit_splitting;
}

/// More ranks than cores share no more work, and whenever they meet the last one has to wait until
/// the others have had their turn on its core.
double turns(const ResolvedCase& resolved, double cores) {
    const auto ranks = static_cast<double>(resolved.settings.integer("fluid.ranks"));
    // (ranks - cores)/cores others have their turn on a core before the last one.
    return ranks > cores ? meetings * time_slice * (ranks - cores) / cores : 0.0;
}

double ranks_with_a_core(const Settings& settings, const char* key, double cores) {
    return std::min(cores, static_cast<double>(settings.integer(key)));
}

double fluid_time(const ResolvedCase& resolved, double cores) {
    const Settings& settings = resolved.settings;
    if (!settings.flag("fluid.enabled")) return 0.0;
    const auto [cell, covered] = rates(settings);
    const bool stages = settings.text("fluid.time_scheme") == "second-order";
    const double ranks = ranks_with_a_core(settings, "fluid.ranks", cores);
    return turns(resolved, cores) +
           cell * (stages ? second_order : 1.0) * fluid_cells(settings) / ranks +
           // The busiest rank decides, with 1.6 times its equal share of the covered cells, or all
           // of them.
           covered * covered_cells(resolved) * std::min(1.0, busiest_share / ranks);
}

double time_per_substep(const ResolvedCase& resolved) {
    return all_round(resolved) ? grains_adapter(resolved.settings).disc_substep : spring_step;
}

double time_per_grain(const ResolvedCase& resolved) {
    const Settings& settings = resolved.settings;
    if (grains_adapter(settings).host == GrainsHost::command) return external_code;
    if (settings.has("run.md_substeps"))
        return time_per_substep(resolved) *
               static_cast<double>(settings.integer("run.md_substeps"));
    if (in_space(settings)) return sphere_contacts;
    return all_round(resolved) ? disc_contacts : polygon_contacts;
}

/// A repeated window repeats its sub-steps; contact solves with the fluid's inertia begin where the
/// last one ended.
double grains_time(const ResolvedCase& resolved, double cores) {
    const bool repeated = scheme_of(resolved).repeats;
    const double ranks = ranks_with_a_core(resolved.settings, "grains.ranks", cores);
    return time_per_grain(resolved) * count(resolved) * (repeated ? rounds(resolved) : 1.0) / ranks;
}

/// Messages of a window that wait for the one before: call_order.cpp.
double messages_in_turn(const ResolvedCase& resolved) {
    const SchemeEntry& scheme = scheme_of(resolved);
    if (scheme.fluid.empty()) return 4.0;
    // split: window, motion, constraint, kicks, kick, state. With rounds: a round is contact_input,
    // motion, constraint, response; around them bodies, response, accept, kicks, kick, state.
    return scheme.has_rounds() ? 6.0 + 4.0 * rounds(resolved) : 6.0;
}

bool in_yade(const Settings& settings) {
    return grains_adapter(settings).host == GrainsHost::yade;
}

double cores_of_this_machine() {
    return std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace

double WindowForecast::seconds() const {
    // All programs wait for the coupler and for messages.
    return (side_by_side ? std::max(fluid, grains) : fluid + grains) + coupler + messages;
}

double cores_for_a_job() {
    for (const char* nodes : {"SLURM_JOB_NUM_NODES", "SLURM_NNODES", "PBS_NUM_NODES"})
        if (const char* given = std::getenv(nodes); given != nullptr && std::atoi(given) > 1)
            // So that no warning compares the ranks of a batch job with the cores of the machine it
            // is sent from.
            return std::numeric_limits<double>::infinity();
    return cores_of_this_machine();
}

double cores_here() {
    double cores = cores_of_this_machine();
    for (const char* tasks : {"SLURM_NTASKS", "PBS_NP"})
        if (const char* given = std::getenv(tasks); given != nullptr && std::atoi(given) > 0)
            cores = std::min<double>(cores, std::atoi(given));
    return cores;
}

std::string ranks_warning(const ResolvedCase& resolved, double cores) {
    const Settings& settings = resolved.settings;
    if (!settings.flag("fluid.enabled")) return "";
    const auto ranks = static_cast<double>(settings.integer("fluid.ranks"));
    if (ranks <= cores) return "";
    ResolvedCase fewer = resolved;
    fewer.settings.set("fluid.ranks", fmt::format("{:.0f}", cores));
    return fmt::format(
        "fluid.ranks = {:.0f} on {:.0f} cores: ranks beyond the cores wait for each other, and a "
        "window takes {:.2g} times as long as with {:.0f}. Use fluid.ranks = {:.0f} or fewer here.",
        ranks, cores,
        forecast_window(resolved, cores).seconds() / forecast_window(fewer, cores).seconds(), cores,
        cores);
}

std::int64_t best_grains_ranks(std::size_t spheres, double cores) {
    // Each with as many spheres as two ranks need to pay.
    const double paying = 2.0 * static_cast<double>(spheres) / grains_for_ranks;
    return static_cast<std::int64_t>(std::max(1.0, std::floor(std::min(cores, paying))));
}

std::string grains_ranks_warning(const ResolvedCase& resolved, double cores) {
    const Settings& settings = resolved.settings;
    if (!shares_contacts(settings)) return "";
    const auto ranks = static_cast<double>(settings.integer("grains.ranks"));
    const std::string begin = fmt::format(
        "grains.ranks = {:.0f} for {:.0f} grains on {:.0f} cores: ", ranks, count(resolved), cores);
    if (ranks > cores)
        return begin + fmt::format(
                           "ranks wait for each other eight times per sweep, and those beyond the "
                           "cores make all the others wait. Use grains.ranks = {} here.",
                           best_grains_ranks(resolved.population.size(), cores));
    if (count(resolved) >= grains_for_ranks) return "";
    return begin + fmt::format(
                       "ranks wait for each other eight times per sweep, which pays from about "
                       "{:.0f} grains on. Use grains.ranks = 1 here.",
                       grains_for_ranks);
}

WindowForecast forecast_window(const ResolvedCase& resolved, double cores) {
    return {.fluid = fluid_time(resolved, cores),
            .grains = grains_time(resolved, cores),
            .coupler = checks * count(resolved),
            .messages = handover * messages_in_turn(resolved),
            .side_by_side = scheme_of(resolved).side_by_side()};
}

double predicted_seconds(const ResolvedCase& resolved) {
    const Settings& settings = resolved.settings;
    const double mesh = has_openfoam(settings) ? fluid_cells(settings) : 0.0;
    const double start =
        seconds_to_start + (in_yade(settings) ? seconds_of_yade : 0.0) + seconds_per_cell * mesh;
    const auto windows = static_cast<double>(settings.integer("run.windows"));
    return start + forecast_window(resolved).seconds() * windows;
}

double predicted_memory(const ResolvedCase& resolved) {
    const Settings& settings = resolved.settings;
    const double host = in_yade(settings) ? of_yade : of_other_hosts;
    const double programs =
        of_coupler + host * static_cast<double>(settings.integer("grains.ranks"));
    const bool space = in_space(settings);
    const double of_coupler_each = space ? of_coupler_per_sphere : of_coupler_per_grain;
    const double grains = (of_coupler_each + of_host_per_grain) * count(resolved);
    return (settings.flag("fluid.enabled") ? fluid_memory(settings) : 0.0) +
           (programs + grains) / gigabyte;
}

std::string rough_time(double seconds) {
    if (seconds < 100.0) return fmt::format("{:.0f} s", std::max(1.0, seconds));
    if (seconds < 6000.0) return fmt::format("{:.0f} min", seconds / 60.0);
    if (seconds < 172800.0) return fmt::format("{:.0f} h", seconds / 3600.0);
    return fmt::format("{:.0f} days", seconds / 86400.0);
}

}  // namespace turbidite
