// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Flows within walls inside the box that have an exact answer, at D/8.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fluid_adapter/box_app/array_store.hpp"
#include "fluid_adapter/fluid_window/fluid_window.hpp"
#include "tests/run_settings.hpp"

namespace turbidite {
namespace {

constexpr double edge = 1.0 / 8.0;
constexpr double viscosity = 0.2;
constexpr double step = 0.04;

/// A box of 8 cells along the axis of round walls, which is cyclic, and 5 D across.
struct Box {
    Box(int along, const std::string& splitting, const std::string& walls, double driven = 0.0)
        : axis(along) {
        std::array<int, 3> cells{40, 40, 40};
        cells[along] = 8;
        std::array<Side, 3> sides{Side::wall, Side::wall, Side::wall};
        sides[along] = Side::cyclic;
        box.grid = grid_of_cubes(cells, edge, sides);
        box.viscosity = viscosity;
        box.rigid_grains = splitting != "marchuk-yanenko";
        settings.set("run.dimension", std::int64_t{3});
        const char* sizes[] = {"run.size_x", "run.size_y", "run.size_z"};
        for (int a = 0; a < 3; ++a) settings.set(sizes[a], cells[a] * edge);
        const char* both[3][2] = {{"domain.left", "domain.right"},
                                  {"domain.bottom", "domain.top"},
                                  {"domain.front", "domain.back"}};
        for (int a = 0; a < 3; ++a)
            for (const char* side : both[a])
                settings.set(side, std::string(a == along ? "cyclic" : "wall"));
        settings.set("run.acceleration_x", driven);
        settings.set("run.acceleration_z", 0.0);
        settings.set("run.surface_shift", 0.3 * edge);
        settings.set("run.walls", walls);
        settings.set("fluid.splitting", splitting);
        settings.set("fluid.splitting_iterations", std::int64_t{400});
        settings.set("fluid.splitting_tolerance", 1e-6);
    }

    /// The window's report of the last one.
    FluidReport play(int windows) {
        store.emplace(box);
        FluidWindow window(*store, settings, {{"sphere", {}}});
        FluidReport report;
        for (int index = 0; index < windows; ++index) {
            window.advance({index, index * step, step, false});
            window.correct({});
            report = window.impose().report;
            largest_defect = std::max(largest_defect, report.momentum_defect);
        }
        return report;
    }

    /// A component of u in the cell at a place.
    double velocity(int component, double x, double y, double z) {
        const CellGrid& grid = store->field().grid();
        const int cell = store->field().cell(grid.layer(0, x), grid.layer(1, y), grid.layer(2, z));
        return store->field().velocity(component)[cell];
    }

    int axis;
    ArrayBox box;
    Settings settings = run_settings();
    std::optional<ArrayStore> store;
    double largest_defect = 0.0;
};

/// KIND X Y Z A R1 0 THICKNESS, at rest or turning about its axis.
std::string cylinder(int id, const std::string& place, const std::string& axis, double radius,
                     double thickness, const std::string& spin = "0 0 0") {
    return std::to_string(id) + " cylinder " + place + " " + axis + " 0 0 0 " +
           std::to_string(radius) + " 0 " + std::to_string(thickness) + " 0 0 0 " + spin + " " +
           place + " 0 -1";
}

class FlowsWithinWalls : public testing::TestWithParam<std::string> {
 protected:
    bool paper() const { return GetParam() == "marchuk-yanenko"; }
};

/// A pipe of radius R = 3/2 D, driven from rest by a: u on the axis is
///
///     a R^2/(4 nu) (1 - 8 sum exp(-l^2 nu t/R^2)/(l^3 J_1(l))),   l the zeros of J_0
///
/// and the liquid outside, which a ring across the box holds, does not move.
TEST_P(FlowsWithinWalls, APipe) {
    const double a = 0.3, radius = 1.5;
    Box pipe(0, GetParam(),
             cylinder(1, "0 2.5 2.5", "1 0 0", 1.75, 0.5) +
                 ";2 ring 0.5 2.5 2.5 1 0 0 0 0 0 1.75 3.6 0.5 0 0 0 0 0 0 0.5 2.5 2.5 0 -1",
             a);
    const int windows = 60;
    const FluidReport report = pipe.play(windows);
    double steady = a * radius * radius / (4.0 * viscosity), expected = 1.0;
    for (const double l : {2.404825557695773, 5.520078110286311, 8.653727912911013})
        expected -= 8.0 * std::exp(-l * l * viscosity * windows * step / (radius * radius)) /
                    (l * l * l * std::cyl_bessel_j(1.0, l));
    expected *= steady;
    EXPECT_LT(expected, 0.75 * steady) << "it is still rising";
    // Cells beside the axis
    const double found = pipe.velocity(0, 0.5, 2.51, 2.51);
    EXPECT_NEAR(found, expected, 0.03 * expected);
    // In the first cell beside the wall and outside the paper's splitting, whose viscosity does not
    // know walls, leaves more.
    const double left = found * (1.0 - std::pow(1.4375 / 1.5, 2));
    EXPECT_NEAR(pipe.velocity(0, 0.5, 2.51, 1.1), left, paper() ? 0.08 : 0.04);
    EXPECT_LT(std::abs(pipe.velocity(0, 0.9, 0.3, 0.3)), (paper() ? 0.06 : 0.02) * expected);
    EXPECT_LT(pipe.largest_defect, 1e-9) << "the walls take what the liquid loses";
    EXPECT_LT(std::abs(report.mean_velocity[1]), 1e-9);
}

/// Between a turning cylinder and one at rest (Couette): u = A r + B/r, A = -w R1^2/(R2^2 - R1^2),
/// B = w R1^2 R2^2/(R2^2 - R1^2).
TEST_P(FlowsWithinWalls, TurningCylinders) {
    const double inner = 0.875, outer = 1.875, spin = 1.5;
    Box gap(2, GetParam(),
            cylinder(1, "2.5 2.5 0", "0 0 1", inner - 0.25, 0.5, "0 0 1.5") + ";" +
                cylinder(2, "2.5 2.5 0", "0 0 1", outer + 0.25, 0.5));
    gap.play(150);
    const double b = spin * inner * inner * outer * outer / (outer * outer - inner * inner);
    const double r = 1.4375, expected = b * (1.0 / r - r / (outer * outer));
    // In the middle of the gap, to the right and above: as fast, by symmetry
    const double right = gap.velocity(1, 2.5 + r, 2.51, 0.5);
    const double above = -gap.velocity(0, 2.49, 2.5 + r, 0.5);
    EXPECT_NEAR(right, above, 1e-4 * expected);
    // The paper's splitting takes viscosity and walls one after the other.
    EXPECT_NEAR(right, expected, (paper() ? 0.08 : 0.04) * expected);
    EXPECT_NEAR(gap.velocity(1, 2.5 + 0.5625, 2.51, 0.5), spin * 0.5625, 1e-6) << "in the wall";
    EXPECT_LT(std::abs(gap.velocity(1, 4.9, 2.5, 0.5)), 1e-2 * expected) << "outside";
    EXPECT_LT(gap.largest_defect, 1e-6) << "all impulses cancel";
}

/// Velocities along x of a neutral sphere beside a plate that turns about its lower end, window by
/// window, in a box that is open at the right.
std::vector<double> beside_a_paddle(const std::string& splitting, int windows) {
    constexpr std::array<int, 3> cells{40, 48, 32};
    constexpr double short_step = 0.01;
    Box wide(2, splitting,
             "0 plate 1.6 2.2 0.4 1.7 0.9 0 0 0 3.1 0 0 0.3 0 0 0 0 0 0.6 1.9 2.5 0 0 -1");
    wide.box.grid = grid_of_cubes(cells, edge, {Side::wall, Side::wall, Side::cyclic});
    wide.box.grid.sides[0][1] = Side::open;
    wide.box.viscosity = 1.0 / 20.0;
    wide.settings.set("domain.right", std::string("free"));
    const char* sizes[] = {"run.size_x", "run.size_y", "run.size_z"};
    for (int a = 0; a < 3; ++a) wide.settings.set(sizes[a], cells[a] * edge);
    wide.settings.set("fluid.splitting_tolerance", 1e-3);
    wide.settings.set("run.gravity", 0.0);
    ArrayStore store(wide.box);
    FluidWindow window(store, wide.settings, {{"sphere", {}}});
    GrainState sphere;
    sphere.id = 7;
    sphere.radius = 0.5;
    sphere.density = 1.0;
    sphere.position = {1.2, 3.9, 2.1};
    std::vector<double> velocities;
    for (int index = 0; index < windows; ++index) {
        window.advance({index, index * short_step, short_step, false});
        window.correct({sphere});
        const Kicks kicks = window.impose();
        sphere.velocity = kicks.kicks[0].velocity;
        sphere.angular_velocity = kicks.kicks[0].angular_velocity;
        sphere.position = sphere.position + short_step * sphere.velocity;
        velocities.push_back(sphere.velocity[0]);
    }
    return velocities;
}

// The first window finds the pressure of the jump, the others follow it with an iteration each, and
// what it leaves does not swing.
TEST(PushedLiquid, OneIterationPerWindowFollowsWithoutASwing) {
    const std::vector<double> once = beside_a_paddle("explicit-multiplier", 50);
    const std::vector<double> all = beside_a_paddle("implicit-multiplier", 50);
    EXPECT_LT(all.front(), -0.04) << "the paddle sets the sphere in motion";
    for (std::size_t n = 0; n < once.size(); ++n)
        EXPECT_NEAR(once[n], all[n], 0.05 * std::abs(all[n])) << n;
    for (std::size_t n = 2; n < once.size(); ++n)
        EXPECT_LT(std::abs(once[n] - 2.0 * once[n - 1] + once[n - 2]), 0.002) << n;
}

INSTANTIATE_TEST_SUITE_P(Splittings, FlowsWithinWalls,
                         testing::Values("marchuk-yanenko", "explicit-multiplier",
                                         "implicit-multiplier"),
                         [](const auto& info) {
                             std::string name = info.param;
                             name[name.find('-')] = '_';
                             return name;
                         });

}  // namespace
}  // namespace turbidite
