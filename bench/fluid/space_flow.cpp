// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Spheres in a fluid in space, without a coupler: figures that have published or exact values.
//
//     turbidite-bench-space array --fraction 0.064 --cells 20 --shift 0.25
//     turbidite-bench-space settle --cells-per-diameter 8 --shift 0.25
//
// `array`: the drag K = F/(6 pi eta R U) of a simple cubic array in Stokes flow, at random places
// in the grid; published: 2.008, 2.810 and 4.292 at 0.027, 0.064 and 0.125 (Zick and Homsy 1982).
// `settle`: how a settling sphere's speed varies with its place in the grid.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "coupler/protocol/scene/splitting.hpp"
#include "fluid_adapter/box_app/array_store.hpp"
#include "fluid_adapter/fluid_window/fluid_window.hpp"

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

struct ArrayCase {
    double fraction = 0.064;
    int cells = 20, offsets = 8;
    double shift = 0.25, viscous_number = 0.2;
    std::string splitting = "explicit-multiplier";
};

/// K at one place of the sphere.
double drag_of_array(const ArrayCase& of, const Vec3& offset) {
    const double length = std::cbrt(pi / 6.0 / of.fraction);
    Flow flow;
    flow.cells.fill(of.cells);
    flow.edge = length / of.cells;
    flow.sides.fill(Side::cyclic);
    flow.shift = of.shift;
    flow.splitting = of.splitting;
    flow.step = of.viscous_number * flow.edge * flow.edge;
    flow.acceleration = {1e-3, 0.0, 0.0};
    flow.velocity = 1e-4;
    Play play(flow);
    GrainState fixed = sphere(flow.edge * offset + 0.5 * length * Vec3{1.0, 1.0, 1.0}, 1.5);
    fixed.prescribed = true;
    std::vector<GrainState> grains = {fixed};
    double before = 0.0, now = 0.0;
    const int check = std::max(1, static_cast<int>(0.05 * length * length / flow.step));
    for (int window = 0; window < 200000; ++window) {
        play.next(grains);
        if (window % check != check - 1) continue;
        before = std::exchange(now, play.mean_velocity()[0]);
        if (std::abs(now - before) < 1e-5 * std::abs(now)) break;
    }
    // rho a L^3 = 6 pi eta R U K
    return flow.acceleration[0] * length * length * length / (3.0 * pi * now);
}

void print_array(const ArrayCase& of) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(0.0, 1.0);
    const double length = std::cbrt(pi / 6.0 / of.fraction);
    double low = 1e300, high = 0.0, sum = 0.0;
    for (int n = 0; n < of.offsets; ++n) {
        const double x = place(random), y = place(random), z = place(random);
        const double drag = drag_of_array(of, {x, y, z});
        low = std::min(low, drag), high = std::max(high, drag), sum += drag;
    }
    std::printf("c %.4g  D/h %.2f  shift %.3g  nu dt/h2 %.3g  %s: K %.4f (%.4f to %.4f)\n",
                of.fraction, of.cells / length, of.shift, of.viscous_number, of.splitting.c_str(),
                sum / of.offsets, low, high);
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
    ArrayCase array;
    CLI::App* arrays = app.add_subcommand("array", "drag of a simple cubic array in Stokes flow");
    arrays->add_option("--fraction", array.fraction, "volume fraction");
    arrays->add_option("--cells", array.cells, "cells along the period");
    arrays->add_option("--shift", array.shift, "of the surface, in cells");
    arrays->add_option("--viscous-number", array.viscous_number, "nu dt/h2");
    arrays->add_option("--offsets", array.offsets, "random places of the sphere in the grid");
    arrays->add_option("--splitting", array.splitting);
    SettleCase settle;
    CLI::App* settles = app.add_subcommand("settle", "a sphere settles");
    settles->add_option("--cells-per-diameter", settle.per_diameter);
    settles->add_option("--width", settle.width, "of the cyclic box, in D");
    settles->add_option("--height", settle.height, "in D");
    settles->add_option("--viscosity", settle.viscosity, "in D sqrt(g D)");
    settles->add_option("--density", settle.density, "of the sphere over that of the fluid");
    settles->add_option("--step", settle.step, "in sqrt(D/g)");
    settles->add_option("--shift", settle.shift, "of the surface, in cells");
    settles->add_option("--splitting", settle.splitting);
    CLI11_PARSE(app, argc, argv);
    if (*arrays) print_array(array);
    if (*settles) print_settling(settle);
    return 0;
}
