// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Spheres in a fluid in space, without a coupler: figures that have published or exact values.
//
//     turbidite-bench-space array --fraction 0.064 --cells 20 --shift 0.25
//     turbidite-bench-space packing --kind random --fraction 0.6 --cells 28 --shift 0.12
//     turbidite-bench-space settle --cells-per-diameter 8 --shift 0.25
//
// `array`: the drag K = F/(6 pi eta R U) of a simple cubic array in Stokes flow, at random places
// in the grid; published: 2.008, 2.810 and 4.292 at 0.027, 0.064 and 0.125 (Zick and Homsy 1982).
// `packing`: the permeability k = nu U/a of dense packings in Stokes flow.
// `settle`: how a settling sphere's speed varies with its place in the grid.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "coupler/protocol/scene/splitting.hpp"
#include "fluid_adapter/box_app/array_store.hpp"
#include "fluid_adapter/fluid_window/fluid_window.hpp"
#include "granular_adapter/nscd/problem/periodic_box.hpp"

namespace turbidite {
namespace {

using std::numbers::pi;

/// Lengths are in D, masses in rho_f D^3.
struct Flow {
    std::array<int, 3> cells{};
    double edge = 0.0;
    std::array<Side, 3> sides{};
    double viscosity = 1.0, step = 0.01, gravity = 0.0, shift = 0.0;
    Vec3 acceleration{};
    std::string splitting = "explicit-multiplier";
    double splitting_tolerance = 1e-4;  // u_c/D
    double velocity = 1.0;              // u_c
};

const char* name_of(Side side) {
    return side == Side::cyclic ? "cyclic" : side == Side::wall ? "wall" : "free";
}

Settings settings_of(const Flow& flow) {
    Settings s;
    s.set("run.dimension", std::int64_t{3});
    s.set("fluid.enabled", true);
    s.set("fluid.splitting", flow.splitting);
    s.set("fluid.splitting_tolerance", flow.splitting_tolerance);
    s.set("fluid.splitting_iterations", std::int64_t{400});
    s.set("fluid.hydrodynamic_radius", 1.0);
    s.set("run.surface_shift", flow.shift * flow.edge);
    const char* names[3][2] = {{"left", "right"}, {"bottom", "top"}, {"front", "back"}};
    for (int axis = 0; axis < 3; ++axis)
        for (const char* side : names[axis])
            s.set(std::string("domain.") + side, std::string(name_of(flow.sides[axis])));
    for (const char* unit : {"diameter", "time_scale", "grain_weight", "fluid_density"})
        s.set(std::string("run.") + unit, 1.0);
    s.set("run.velocity_scale", flow.velocity);
    s.set("run.gravity", flow.gravity);
    s.set("run.viscosity", flow.viscosity);
    const char* axes[] = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        s.set(std::string("run.acceleration_") + axes[axis], flow.acceleration[axis]);
        s.set(std::string("run.size_") + axes[axis], flow.cells[axis] * flow.edge);
    }
    s.set("run.step", flow.step);
    s.set("run.windows", std::int64_t{1000000});
    s.set("run.output_every", std::int64_t{1000000});
    return s;
}

ArrayBox box_of(const Flow& flow) {
    ArrayBox box;
    box.grid = grid_of_cubes(flow.cells, flow.edge, flow.sides);
    box.viscosity = flow.viscosity;
    box.rigid_grains = splitting_of(settings_of(flow)).rigid_grains;
    return box;
}

GrainState sphere(const Vec3& at, double density) {
    GrainState state;
    state.id = 1;
    state.radius = 0.5;
    state.density = density;
    state.position = at;
    return state;
}

/// Spheres in a flow, without contacts.
class Play {
 public:
    explicit Play(const Flow& flow)
        : flow_(flow), store_(box_of(flow)), window_(store_, settings_of(flow), {{"sphere", {}}}) {}

    Kicks next(std::vector<GrainState>& grains) {
        const double time = static_cast<double>(index_) * flow_.step;
        window_.advance({index_++, time, flow_.step, false});
        window_.let_fall(grains);
        Kicks kicks = window_.impose();
        for (std::size_t g = 0; g < grains.size(); ++g) {
            const Kick& kick = kicks.kicks.at(g);
            grains[g].velocity = kick.velocity;
            grains[g].angular_velocity = kick.angular_velocity;
            grains[g].position = grains[g].position + flow_.step * kick.velocity;
        }
        return kicks;
    }

    Vec3 mean_velocity() const {
        const FluidMomentum momentum = const_cast<ArrayStore&>(store_).field().momentum();
        const double volume =
            flow_.cells[0] * flow_.cells[1] * flow_.cells[2] * flow_.edge * flow_.edge * flow_.edge;
        return momentum.sum / volume;
    }

 private:
    Flow flow_;
    ArrayStore store_;
    FluidWindow window_;
    std::int64_t index_ = 0;
};

/// Fixed spheres in a cyclic cube.
struct Packing {
    double length = 1.0;
    std::vector<Vec3> centres;

    nscd::PeriodicBox box() const { return {.length = {length, length, length}}; }
};

/// The edge of a cube that so many spheres fill to this fraction.
double period(int count, double fraction) {
    return std::cbrt(count * pi / 6.0 / fraction);
}

Packing simple_cubic(double fraction) {
    return {period(1, fraction), {Vec3{}}};
}

/// Face-centred cubic: four spheres per cube.
Packing face_centred(double fraction) {
    const double length = period(4, fraction), half = 0.5 * length;
    return {length, {Vec3{}, {half, half, 0.0}, {half, 0.0, half}, {0.0, half, half}}};
}

/// Random places, pushed apart until no two spheres overlap by more than 1e-3 D: to 0.62 or so.
Packing random_packing(double fraction, int count, unsigned seed) {
    Packing packing{period(count, fraction), std::vector<Vec3>(count)};
    const nscd::PeriodicBox box = packing.box();
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0.0, packing.length);
    for (Vec3& centre : packing.centres) {
        const double x = place(random), y = place(random);
        centre = {x, y, place(random)};
    }
    double overlap = 1.0;
    for (int round = 0; round < 200000 && overlap > 1e-3; ++round) {
        overlap = 0.0;
        for (int a = 0; a < count; ++a)
            for (int b = a + 1; b < count; ++b) {
                const Vec3 d = box.minimum_image(packing.centres[b] - packing.centres[a]);
                const double distance = norm(d);
                if (distance >= 1.0) continue;
                overlap = std::max(overlap, 1.0 - distance);
                const Vec3 push = (0.5 * (1.0 - distance) / distance) * d;
                packing.centres[a] = packing.centres[a] - push;
                packing.centres[b] = packing.centres[b] + push;
            }
    }
    if (overlap > 1e-3) throw std::runtime_error("these spheres do not fit at that fraction");
    return packing;
}

struct StokesCase {
    int cells = 20;
    double shift = 0.25, viscous_number = 0.2;
    std::string splitting = "explicit-multiplier";
};

/// Mean velocity U of a liquid that a force rho a drives slowly through fixed spheres, over nu
/// a/D^2 with nu = 1: what the force does not lose is the drag of the spheres, rho a L^3 = sum F.
double superficial_velocity(const Packing& packing, const StokesCase& of, const Vec3& offset) {
    Flow flow;
    flow.cells.fill(of.cells);
    flow.edge = packing.length / of.cells;
    flow.sides.fill(Side::cyclic);
    flow.shift = of.shift;
    flow.splitting = of.splitting;
    flow.step = of.viscous_number * flow.edge * flow.edge;
    flow.acceleration = {1e-3, 0.0, 0.0};
    flow.velocity = 1e-4;
    Play play(flow);
    std::vector<GrainState> grains;
    for (const Vec3& centre : packing.centres) {
        const Vec3 at = flow.edge * offset + centre + 0.5 * packing.length * Vec3{1.0, 1.0, 1.0};
        grains.push_back(sphere(packing.box().wrap(at), 1.5));
        grains.back().id = static_cast<GrainId>(grains.size());
        grains.back().prescribed = true;
    }
    // The flow is steady when it changes by less than 1e-5 within a twentieth of the diffusion time
    // of the cube, or of a pore of a packing, 0.3 D wide.
    const double width = packing.centres.size() > 1 ? 0.3 : packing.length;
    const int check = std::max(5, static_cast<int>(0.05 * width * width / flow.step));
    double now = 0.0;
    for (int window = 0; window < 200000; ++window) {
        play.next(grains);
        if (window % check != check - 1) continue;
        const double before = std::exchange(now, play.mean_velocity()[0]);
        if (std::abs(now - before) < 1e-5 * std::abs(now)) return now / flow.acceleration[0];
    }
    throw std::runtime_error(
        "the flow is not steady after 200,000 windows: use a larger "
        "--viscous-number");
}

/// Velocities at random places of the packing in the grid.
std::vector<double> velocities(const Packing& packing, const StokesCase& of, int offsets) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(0.0, 1.0);
    std::vector<double> all;
    for (int n = 0; n < offsets; ++n) {
        const double x = place(random), y = place(random), z = place(random);
        all.push_back(superficial_velocity(packing, of, {x, y, z}));
    }
    return all;
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void print_array(double fraction, const StokesCase& of, int offsets) {
    const Packing packing = simple_cubic(fraction);
    // rho a L^3 = 6 pi eta R U K
    const double all = std::pow(packing.length, 3) / (3.0 * pi);
    std::vector<double> drags;
    for (const double velocity : velocities(packing, of, offsets)) drags.push_back(all / velocity);
    std::printf("c %.4g  D/h %.2f  shift %.3g  nu dt/h2 %.3g  %s: K %.4f (%.4f to %.4f)\n",
                fraction, of.cells / packing.length, of.shift, of.viscous_number,
                of.splitting.c_str(), mean(drags), *std::ranges::min_element(drags),
                *std::ranges::max_element(drags));
    std::fflush(stdout);
}

void print_permeability(const Packing& packing, const StokesCase& of, int offsets) {
    // Darcy: U = k/(rho nu) rho a
    const std::vector<double> k = velocities(packing, of, offsets);
    const double count = static_cast<double>(packing.centres.size());
    const double fraction = count * pi / 6.0 / std::pow(packing.length, 3), pores = 1.0 - fraction;
    std::printf(
        "%d spheres  c %.4g  D/h %.2f  shift %.3g  nu dt/h2 %.3g  %s: k/D2 %.4e (%.4e to "
        "%.4e)  drag of one K %.1f  Carman-Kozeny %.4e\n",
        static_cast<int>(count), fraction, of.cells / packing.length, of.shift, of.viscous_number,
        of.splitting.c_str(), mean(k), *std::ranges::min_element(k), *std::ranges::max_element(k),
        std::pow(packing.length, 3) / (3.0 * pi * count * mean(k)),
        std::pow(pores, 3) / (180.0 * fraction * fraction));
    std::fflush(stdout);
}

struct SettleCase {
    int per_diameter = 8;
    double width = 6.0, height = 16.0, viscosity = 0.019, density = 1.5, step = 0.02;
    double shift = 0.25;
    std::string splitting = "explicit-multiplier";
};

/// From 3 D below the top to 3 D above the floor; statistics over the lower half of the way.
void print_settling(const SettleCase& of) {
    Flow flow;
    flow.edge = 1.0 / of.per_diameter;
    const int across = static_cast<int>(std::lround(of.width * of.per_diameter));
    flow.cells = {across, static_cast<int>(std::lround(of.height * of.per_diameter)), across};
    flow.sides = {Side::cyclic, Side::wall, Side::cyclic};
    flow.viscosity = of.viscosity;
    flow.step = of.step;
    flow.gravity = 1.0;
    flow.shift = of.shift;
    flow.splitting = of.splitting;
    flow.velocity = 0.5;
    Play play(flow);
    std::vector<GrainState> grains = {
        sphere({0.5 * of.width + 0.013, of.height - 3.0, 0.5 * of.width + 0.029}, of.density)};
    std::vector<double> speeds;
    double defect = 0.0, largest_jump = 0.0, sideways = 0.0;
    while (grains[0].position[1] > 3.0) {
        const Kicks kicks = play.next(grains);
        defect = std::max(defect, kicks.report.momentum_defect);
        const double speed = -grains[0].velocity[1];
        if (!(std::abs(speed) < 10.0)) return void(std::puts("the sphere was thrown"));
        if (grains[0].position[1] > 0.5 * of.height) continue;
        if (!speeds.empty()) largest_jump = std::max(largest_jump, std::abs(speed - speeds.back()));
        sideways =
            std::max({sideways, std::abs(grains[0].velocity[0]), std::abs(grains[0].velocity[2])});
        speeds.push_back(speed);
    }
    // Deviations from the mean over a way of one D, in which the trend is small.
    const int about = static_cast<int>(1.0 / (speeds.back() * of.step));
    double square = 0.0, largest = 0.0, mean_of_all = 0.0;
    int count = 0;
    for (int w = about; w + about < static_cast<int>(speeds.size()); ++w) {
        double mean = 0.0;
        for (int v = -about; v <= about; ++v) mean += speeds[w + v] / (2 * about + 1);
        const double off = speeds[w] / mean - 1.0;
        square += off * off, largest = std::max(largest, std::abs(off));
        mean_of_all += mean, ++count;
    }
    mean_of_all /= count;
    std::printf(
        "D/%d shift %.3g %s: Re %.1f  speed %.4f  ripple rms %.2f %% largest %.2f %%, from "
        "window to window %.3f %%  sideways %.1e  momentum defect %.1e\n",
        of.per_diameter, of.shift, of.splitting.c_str(), mean_of_all / of.viscosity, mean_of_all,
        100.0 * std::sqrt(square / count), 100.0 * largest, 100.0 * largest_jump / mean_of_all,
        sideways / mean_of_all, defect);
}

}  // namespace
}  // namespace turbidite

int main(int argc, char** argv) {
    using namespace turbidite;
    CLI::App app{"figures of spheres in a fluid, without a coupler"};
    app.require_subcommand(1);
    StokesCase stokes;
    double fraction = 0.064;
    int offsets = 8, count = 50;
    unsigned seed = 1;
    std::string kind = "random";
    const auto add_stokes = [&](CLI::App* command) {
        command->add_option("--fraction", fraction, "volume fraction of the spheres");
        command->add_option("--cells", stokes.cells, "cells along the period");
        command->add_option("--shift", stokes.shift, "of the surface, in cells");
        command->add_option("--viscous-number", stokes.viscous_number, "nu dt/h2");
        command->add_option("--offsets", offsets, "random places in the grid");
        command->add_option("--splitting", stokes.splitting);
    };
    CLI::App* arrays = app.add_subcommand("array", "drag of a simple cubic array in Stokes flow");
    CLI::App* packings = app.add_subcommand("packing", "permeability of a packing in Stokes flow");
    add_stokes(arrays);
    add_stokes(packings);
    packings->add_option("--kind", kind, "fcc: face-centred cubic, or random")
        ->check(CLI::IsMember({"fcc", "random"}));
    packings->add_option("--count", count, "of random spheres");
    packings->add_option("--seed", seed, "of random spheres");
    SettleCase settle;
    CLI::App* settles = app.add_subcommand("settle", "a sphere settles");
    settles->add_option("--cells-per-diameter", settle.per_diameter);
    settles->add_option("--width", settle.width, "of the cyclic box, in D");
    settles
        ->add_option("--height", settle.height,
                     "in D; it begins 3 D below the top, and is measured between the middle and "
                     "3 D above the floor")
        ->check(CLI::Range(9.0, 1e4));
    settles->add_option("--viscosity", settle.viscosity, "in D sqrt(g D)");
    settles->add_option("--density", settle.density, "of the sphere over that of the fluid");
    settles->add_option("--step", settle.step, "in sqrt(D/g)");
    settles->add_option("--shift", settle.shift, "of the surface, in cells");
    settles->add_option("--splitting", settle.splitting);
    CLI11_PARSE(app, argc, argv);
    try {
        if (*arrays) print_array(fraction, stokes, offsets);
        if (*packings)
            print_permeability(
                kind == "fcc" ? face_centred(fraction) : random_packing(fraction, count, seed),
                stokes, offsets);
        if (*settles) print_settling(settle);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "space-flow: %s\n", error.what());
        return 1;
    }
    return 0;
}
