// SPDX-License-Identifier: GPL-3.0-or-later
//
// Walls inside the box, and grains that follow a motion, in the fluid. Run units: D = u_c = rho_f =
// 1.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/physics/coupled_run.hpp"

namespace turbidite {
namespace {

constexpr double pi = std::numbers::pi;

/// With a friction and two cells thick.
std::string plate(const std::string& text, const CoupledSetup& setup) {
    return text + " 0.3 " + std::to_string(2.0 / setup.cells_per_diameter);
}

CoupledSetup channel(int cells, const std::string& splitting) {
    CoupledSetup setup = with_sides({"", "cyclic", "cyclic", "wall", "wall"});
    setup.cells_per_diameter = cells;
    setup.splitting = splitting;
    setup.width = 0.5;
    setup.tolerance = 1e-8;
    return setup;
}

double velocity_at(CoupledRun& run, int j) {
    return run.fluid().velocity(2, j)[0];
}

class Plates : public testing::TestWithParam<const char*> {};

/// Largest velocity below the plate, and largest difference from u = (y - 1)/2 above it, with a lid
/// at y = 3 and the plate at y = 1.
std::array<double, 2> below_and_off(CoupledSetup setup, int windows) {
    setup.height = 3.0;
    setup.windows = windows;
    setup.reynolds = 0.5;
    setup.walls = plate("1 0 1 0.5 1 0 0 0 0.25 1", setup);
    setup.wall_motions = "3 constant 1 0 0";
    CoupledRun run(setup, {});
    for (int n = 0; n < windows; ++n) run.advance();
    EXPECT_LT(run.answer().report.momentum_defect, 1e-8);
    double off = 0.0, below = 0.0;
    for (int j = 0; j < 3 * setup.cells_per_diameter; ++j) {
        const double y = (j + 0.5) / setup.cells_per_diameter, u = velocity_at(run, j);
        double& most = y > 1.0 ? off : below;
        most = std::max(most, std::abs(u - std::max(0.0, 0.5 * (y - 1.0))));
    }
    return {below, off};
}

/// The fluid is at rest from the plate's cell centres on: of first order. Below it nothing moves.
TEST_P(Plates, HoldTheFluidBetweenThemAndALid) {
    CoupledSetup coarse = channel(8, GetParam()), fine = channel(16, GetParam());
    const bool splits_viscosity = GetParam() == std::string("marchuk-yanenko");
    coarse.step = fine.step = splits_viscosity ? 0.0005 : 0.02;
    const int windows = splits_viscosity ? 6000 : 200;
    const auto [below, off] = below_and_off(coarse, windows);
    const auto [finely_below, finely_off] = below_and_off(fine, windows);
    // The paper's splitting lets viscosity act through it for a step.
    EXPECT_LT(std::max(below, finely_below), splits_viscosity ? 2e-3 : 1e-12);
    EXPECT_LT(off, 0.035);
    EXPECT_GT(off / finely_off, 1.9);
}

/// A plate that oscillates along itself, with velocity cos(w t): Stokes' second problem on both
/// sides, u = exp(-k s) cos(w t - k s) at a distance s, k = sqrt(w/2 nu).
double off_stokes_layer(CoupledSetup setup) {
    setup.height = 4.0;
    setup.reynolds = 2.0;
    setup.step = 0.005;
    const double w = 2.0 * pi, k = std::sqrt(0.5 * w * setup.reynolds);
    setup.walls = plate("1 0 2 0.5 2 0 0 0 0.25 2", setup);
    setup.wall_motions = "4 harmonic " + std::to_string(1.0 / w) + " 0 0 1 0";
    CoupledRun run(setup, {});
    for (int n = 0; n < 600; ++n) run.advance();
    double off = 0.0;
    for (int j = 0; j < 4 * setup.cells_per_diameter; ++j) {
        const double s = std::abs((j + 0.5) / setup.cells_per_diameter - 2.0);
        const double expected = std::exp(-k * s) * std::cos(k * s);
        off = std::max(off, std::abs(velocity_at(run, j) - expected));
    }
    return off;
}

TEST_P(Plates, MakeAStokesLayerOnBothSides) {
    const double off = off_stokes_layer(channel(8, GetParam()));
    const double finely_off = off_stokes_layer(channel(16, GetParam()));
    EXPECT_LT(off, 0.17);
    EXPECT_GT(off / finely_off, 1.9);
}

/// A plate across the box, at an angle: a lid moves the fluid on one side only.
TEST_P(Plates, LetNothingThrough) {
    CoupledSetup setup;
    setup.splitting = GetParam();
    setup.cells_per_diameter = 8;
    setup.reynolds = 20.0;
    setup.wall_motions = "3 constant 1 0 0";
    CoupledRun open(setup, {});
    setup.walls = plate("1 0 1.4 4 2.3 0 0 0 2 2", setup);
    CoupledRun closed(setup, {});
    for (int n = 0; n < 300; ++n) open.advance(), closed.advance();
    double through = 0.0, without = 0.0;
    for (int i = 0; i < 32; ++i)
        for (int j = 0; j < 8; ++j) {
            through = std::max(through, std::abs(closed.fluid().velocity(i, j)[0]));
            without = std::max(without, std::abs(open.fluid().velocity(i, j)[0]));
        }
    EXPECT_GT(without, 0.05);
    // The paper's splitting lets pressure and viscosity act through it for a step.
    EXPECT_LT(through, GetParam() == std::string("marchuk-yanenko") ? 0.02 : 1e-4);
}

/// A paddle that turns about one of its ends carries the fluid around.
TEST_P(Plates, StirTheFluid) {
    CoupledSetup setup;
    setup.splitting = GetParam();
    setup.reynolds = 20.0;
    setup.tolerance = 1e-9;
    setup.walls = plate("1 1.9 2 3.3 2 0 0 0.5 1.9 2", setup);
    CoupledRun run(setup, {});
    const int windows = 200;
    for (int n = 0; n < windows; ++n) {
        run.advance();
        ASSERT_LT(run.answer().report.momentum_defect, 1e-8);
    }
    const double angle = 0.5 * (windows - 1) * setup.step;  // at the start of the last window
    for (const double arm : {0.5, 1.0, 1.3}) {
        const int i = static_cast<int>(16.0 * (1.9 + arm * std::cos(angle)));
        const int j = static_cast<int>(16.0 * (2.0 + arm * std::sin(angle)));
        const double x = (i + 0.5) / 16.0 - 1.9, y = (j + 0.5) / 16.0 - 2.0;
        EXPECT_NEAR(run.fluid().velocity(i, j)[0], -0.5 * y, 1e-12);
        EXPECT_NEAR(run.fluid().velocity(i, j)[1], 0.5 * x, 1e-12);
    }
    EXPECT_LT(std::abs(run.fluid().velocity(8, 8)[0]), 0.2);  // elsewhere it lags behind
}

INSTANTIATE_TEST_SUITE_P(Splittings, Plates,
                         testing::Values("marchuk-yanenko", "explicit-multiplier",
                                         "implicit-multiplier"),
                         [](const auto& info) {
                             std::string name = info.param;
                             name[name.find('-')] = '_';
                             return name;
                         });

/// A disc falls on a plate in the fluid and stays there.
TEST(Plates, HoldADisc) {
    CoupledSetup setup;
    setup.cells_per_diameter = 8;
    setup.gravity = 11.86;
    setup.walls = plate("1 1 1 3 1 0 0 0 2 1", setup);
    CoupledRun run(setup, {disc_at(setup, 2.0, 2.2)});
    for (int n = 0; n < 600; ++n) run.advance();
    EXPECT_GT(run.contacts(), 100);
    EXPECT_NEAR(run.grains()[0].position[1], 1.5 + 1.0 / setup.cells_per_diameter, 1e-4);
    EXPECT_LT(std::abs(run.grains()[0].velocity[1]), 1e-4);
}

/// A disc that follows a motion is where it says, and the fluid in it moves with it.
TEST(MovedGrain, TakesTheFluidAlong) {
    CoupledSetup setup;
    setup.cells_per_diameter = 8;
    setup.gravity = 11.86;
    setup.grain_motions = "1 harmonic 0.4 0.2 0 2 0";
    GrainState disc = disc_at(setup, 2.0, 2.0);
    disc.prescribed = true;
    CoupledRun run(setup, {disc});
    const double w = pi;
    for (int n = 1; n <= 250; ++n) {
        run.advance();
        const double shift = std::sin(w * n * setup.step);
        ASSERT_NEAR(run.grains()[0].position[0], 2.0 + 0.4 * shift, 1e-12);
        ASSERT_NEAR(run.grains()[0].position[1], 2.0 + 0.2 * shift, 1e-12);
        const Vec3 centre = run.before()[0].position;
        const Vec3 u = run.fluid().velocity(static_cast<int>(8.0 * centre[0]),
                                            static_cast<int>(8.0 * centre[1]));
        ASSERT_NEAR(u[0], run.grains()[0].velocity[0], 1e-12);
    }
}

}  // namespace
}  // namespace turbidite
