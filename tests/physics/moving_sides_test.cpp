// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sides of the fluid with a prescribed velocity: walls that slide along themselves and inflows, on
// the rows of a box and by OpenFOAM's operators. Run units: D = u_c = rho_f = 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/physics/coupled_run.hpp"

namespace turbidite {
namespace {

constexpr int nx = 27, ny = 34;

/// Sides with motions, and the name of the test parameter.
struct MovingSides {
    Sides sides;
    const char *walls, *inflows, *left_profile;
};

constexpr MovingSides all_sides[] = {
    {{"lids", "wall", "wall", "wall", "wall"},
     "0 harmonic 0 0.3 0 0.15 0;2 table 0 0 0 0 0.05 0.02 0 0 0.2 -0.1 0 0;3 constant 1 0 0",
     "",
     "uniform"},
    {{"channelFlow", "inflow", "free", "wall", "wall"},
     "3 constant -0.4 0 0",
     "0 constant 1 0.1 0",
     "parabolic"},
    {{"flushed", "wall", "free", "inflow", "free"}, "", "2 harmonic 0.01 0.1 0 0.3 0", "uniform"},
    {{"through", "cyclic", "cyclic", "inflow", "inflow"},
     "",
     "2 constant 0 0.8 0;3 constant 0.3 0.8 0",
     "uniform"},
    {{"crossed", "inflow", "inflow", "wall", "wall"},
     "",
     "0 constant 0.7 0 0;1 constant 0.7 0 0",
     "parabolic"},
};

CoupledSetup box_with(const MovingSides& moving) {
    CoupledSetup setup = with_sides(moving.sides);
    setup.wall_motions = moving.walls;
    setup.inflow_motions = moving.inflows;
    setup.left_profile = moving.left_profile;
    setup.cells_per_diameter = 8;
    setup.width = nx / 8.0;
    setup.height = ny / 8.0;
    setup.step = 0.02;
    setup.gravity = 11.86;
    setup.tolerance = 1e-9;
    return setup;
}

std::vector<GrainState> two_discs(const CoupledSetup& setup) {
    return {disc_at(setup, 1.13, 1.02, 0.3, -0.2), disc_at(setup, 2.27, 2.9, -0.4, 0.1)};
}

constexpr double rounding = 1e-11;  // as in fluid_step_test.cpp

class MovingSidesOfTheFluid : public testing::TestWithParam<MovingSides> {};

/// `bounded` selects OpenFOAM's operators (fluid_step_test.cpp).
TEST_P(MovingSidesOfTheFluid, OnRowsAreOpenFoamsOperators) {
    for (const char* time_scheme : {"first-order", "second-order"})
        for (const std::string scheme : {"limitedLinearV 1", "LUST grad(U)", "linear"}) {
            SCOPED_TRACE(std::string(time_scheme) + " " + scheme);
            CoupledSetup rows = box_with(GetParam()), operators = rows;
            rows.time_scheme = operators.time_scheme = time_scheme;
            rows.transport_scheme = "Gauss " + scheme;
            operators.transport_scheme = "bounded Gauss " + scheme;
            CoupledRun one(rows, two_discs(rows)), other(operators, two_discs(operators));
            for (int n = 0; n < 10; ++n) {
                one.advance();
                other.advance();
                EXPECT_LT(one.answer().report.divergence, 1e-11);
                EXPECT_LT(one.answer().report.momentum_defect, 1e-10);
                EXPECT_LT(other.answer().report.momentum_defect, 1e-8);
            }
            EXPECT_LT(largest_difference(one, other, {nx, ny}), 10.0 * rounding);
            EXPECT_GT(one.answer().report.courant, 0.02);
        }
}

/// The sides move, other than at rest, by what they prescribe.
TEST_P(MovingSidesOfTheFluid, MoveTheFluid) {
    CoupledSetup moving = box_with(GetParam()), still = moving;
    still.wall_motions = still.inflow_motions = "";
    CoupledRun one(moving, {}), other(still, {});
    one.advance();
    other.advance();
    EXPECT_GT(largest_difference(one, other, {nx, ny}), 1e-2);
}

TEST_P(MovingSidesOfTheFluid, GoOnFromASavedState) {
    for (const char* scheme : {"Gauss limitedLinearV 1", "bounded Gauss limitedLinearV 1"})
        for (const char* time_scheme : {"first-order", "second-order"}) {
            CoupledSetup setup = box_with(GetParam());
            setup.transport_scheme = scheme;
            setup.time_scheme = time_scheme;
            CoupledRun straight(setup, two_discs(setup)), resumed(setup, two_discs(setup));
            resume_after_three(straight, resumed);
            advance_both(straight, resumed);
            EXPECT_EQ(largest_difference(straight, resumed, {nx, ny}), 0.0);
        }
}

INSTANTIATE_TEST_SUITE_P(Sides, MovingSidesOfTheFluid, testing::ValuesIn(all_sides),
                         [](const auto& info) { return std::string(info.param.sides.name); });

/// u = V y/H is a solution of the discrete equations: linear interpolation, and a wall half a cell
/// from the centres.
TEST(CouetteFlow, IsLinearExactly) {
    CoupledSetup setup = with_sides({"", "cyclic", "cyclic", "wall", "wall"});
    setup.cells_per_diameter = 8;
    setup.width = 1.0;
    setup.height = 2.0;
    setup.reynolds = 0.1;
    setup.step = 0.1;
    setup.wall_motions = "2 constant -0.5 0 0;3 constant 1.5 0 0";
    CoupledRun run(setup, {});
    for (int n = 0; n < 100; ++n) run.advance();
    for (int j = 0; j < 16; ++j)
        EXPECT_NEAR(run.fluid().velocity(3, j)[0], -0.5 + 2.0 * (j + 0.5) / 16.0, 1e-12);
}

/// A plate that oscillates along itself, u = cos(w t) at the wall, H = 4 thick: Stokes' second
/// problem, u = exp(-k y) cos(w t - k y) with k = sqrt(w/2 nu).
TEST(StokesLayer, FollowsAnOscillatingWall) {
    CoupledSetup setup = with_sides({"", "cyclic", "cyclic", "wall", "wall"});
    setup.width = 0.5;
    setup.reynolds = 10.0;
    setup.step = 0.01;
    setup.time_scheme = "second-order";
    const double period = 1.0, w = 2.0 * M_PI / period, k = std::sqrt(0.5 * w * setup.reynolds);
    setup.wall_motions = "2 harmonic " + std::to_string(1.0 / w) + " 0 0 1 0";
    CoupledRun run(setup, {});
    const int windows = 500;
    for (int n = 0; n < windows; ++n) run.advance();
    const double t = windows * setup.step;
    for (int j = 0; j < 32; ++j) {
        const double y = (j + 0.5) / 16.0;
        EXPECT_NEAR(run.fluid().velocity(3, j)[0], std::exp(-k * y) * std::cos(w * t - k * y),
                    0.02);
    }
}

/// A parabola enters, keeps its flux in every column, and its shape to second order. At the end of
/// a window the fluid lacks what step 3 took from it and step 1 gives back: away from the ends it
/// is slower by 1 + 12 nu dt.
TEST(PoiseuilleFlow, KeepsTheProfileWithWhichItEnters) {
    double error[2] = {};
    for (int level = 0; level < 2; ++level) {
        CoupledSetup setup = with_sides({"", "inflow", "free", "wall", "wall"});
        setup.cells_per_diameter = 8 << level;
        setup.width = 3.0;
        setup.height = 1.0;
        setup.reynolds = 10.0;
        setup.step = 0.02;
        setup.inflow_motions = "0 constant 1 0 0";
        setup.left_profile = "parabolic";
        CoupledRun run(setup, {});
        for (int n = 0; n < 400; ++n) run.advance();
        EXPECT_LT(run.answer().report.divergence, 1e-10);  // of the flux that enters
        const int rows = setup.cells_per_diameter;
        for (int i = rows / 2; i < 5 * rows / 2; ++i) {
            double flux = 0.0;
            for (int j = 0; j < rows; ++j) {
                const double y = (j + 0.5) / rows;
                const double u =
                    run.fluid().velocity(i, j)[0] * (1.0 + 12.0 * setup.step / setup.reynolds);
                flux += u / rows;
                error[level] = std::max(error[level], std::abs(u - 6.0 * y * (1.0 - y)));
            }
            EXPECT_NEAR(flux, 1.0, 2e-3) << "column " << i;
        }
    }
    EXPECT_LT(error[1], 0.01);
    EXPECT_GT(error[0] / error[1], 3.0);  // second order: 4
}

/// A plug enters through the bottom and leaves through the open top, or through a top that takes
/// it. Cells beside the inflow see half of the pressure that starts it, as with OpenFOAM's
/// operators: what they lack is carried away with the stream.
TEST(PlugFlow, FillsTheBox) {
    for (const char* top : {"free", "inflow"}) {
        CoupledSetup setup = with_sides({"", "cyclic", "cyclic", "inflow", top});
        setup.cells_per_diameter = 8;
        setup.inflow_motions = "2 constant 0 0.7 0";
        if (std::string(top) == "inflow") setup.inflow_motions += ";3 constant 0 0.7 0";
        CoupledRun run(setup, {});
        for (int n = 0; n < 1000; ++n) {
            run.advance();
            EXPECT_LT(run.answer().report.divergence, 1e-11);
        }
        for (int j = 0; j < 32; ++j)
            for (int i = 0; i < 32; ++i) {
                ASSERT_NEAR(run.fluid().velocity(i, j)[0], 0.0, 1e-12);
                ASSERT_NEAR(run.fluid().velocity(i, j)[1], 0.7, 1e-6);
            }
    }
}

/// Velocities of a free disc in a stream that is switched on at once, window by window.
std::vector<double> in_a_new_stream(const std::string& splitting) {
    CoupledSetup setup = with_sides({"", "inflow", "free", "cyclic", "cyclic"});
    setup.inflow_motions = "0 constant 1 0 0";
    setup.cells_per_diameter = 8;
    setup.width = 6.0;
    setup.splitting = splitting;
    setup.splitting_tolerance = 1e-6;
    CoupledRun run(setup, {disc_at(setup, 2.03, 2.02)});
    std::vector<double> velocities;
    for (int n = 0; n < 10; ++n) {
        run.advance();
        velocities.push_back(run.grains()[0].velocity[0]);
    }
    return velocities;
}

/// The impulse of the first window is none of the second.
TEST(SwitchedOnStream, TakesADiscAlongAtOnce) {
    const std::vector<double> once = in_a_new_stream("explicit-multiplier");
    const std::vector<double> all = in_a_new_stream("implicit-multiplier");
    EXPECT_GT(all.front(), 0.5);
    for (std::size_t n = 0; n < once.size(); ++n) EXPECT_NEAR(once[n], all[n], 0.01 * all[n]) << n;
}

/// Contacts see the wall's velocity: a disc that lies on a sliding floor goes with it.
TEST(SlidingFloor, TakesADiscAlong) {
    CoupledSetup setup;
    setup.cells_per_diameter = 8;
    setup.gravity = 11.86;
    setup.wall_motions = "2 constant 0.5 0 0";
    CoupledRun run(setup, {disc_at(setup, 2.0, 0.5)});
    setup.wall_motions = "";
    CoupledRun still(setup, {disc_at(setup, 2.0, 0.5)});
    for (CoupledRun* each : {&run, &still})
        for (int n = 0; n < 40; ++n) each->advance();
    EXPECT_GT(run.contacts(), 30);
    EXPECT_GT(run.grains()[0].velocity[0], 0.05);
    EXPECT_LT(std::abs(still.grains()[0].velocity[0]), 1e-6);
}

}  // namespace
}  // namespace turbidite
