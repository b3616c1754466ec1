// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh whose rows grow above the grains: steps 1 to 3 on its rows against OpenFOAM's operators on
// the same mesh, flows with an exact solution, and a disc below against the uniform mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/physics/coupled_run.hpp"

namespace turbidite {
namespace {

constexpr Sides bounded_sides[] = {
    {"closed", "wall", "wall", "wall", "wall"},
    {"freeRightAndTop", "wall", "free", "wall", "free"},
    {"freeLeftAndBottom", "free", "wall", "free", "wall"},
    {"channel", "cyclic", "cyclic", "wall", "wall"},
};

constexpr int columns = 27;

/// 32 rows up to 4 D, then rows that grow by up to a tenth to 7 D.
CoupledSetup stretched_box(const Sides& sides) {
    CoupledSetup setup = with_sides(sides);
    setup.cells_per_diameter = 8;
    setup.width = columns / 8.0;
    setup.height = 7.0;
    setup.stretch_ratio = 1.1;
    setup.stretch_from = 4.0;
    setup.step = 0.02;
    setup.gravity = 11.86;
    setup.tolerance = 1e-9;
    return setup;
}

/// Rows of the box above: 32 and the fewest that reach 3 D, (1.1^n - 1) 1.1/0.1 >= 24.
constexpr int rows_of_box = 32 + 13;

std::vector<GrainState> two_discs(const CoupledSetup& setup) {
    return {disc_at(setup, 1.13, 1.02, 0.3, -0.2), disc_at(setup, 2.27, 2.9, -0.4, 0.1)};
}

/// `bounded` subtracts u div phi, which is rounding: the same steps, by OpenFOAM's operators.
CoupledSetup by_operators(CoupledSetup setup) {
    setup.transport_scheme = "bounded " + setup.transport_scheme;
    return setup;
}

class StretchedRows : public testing::TestWithParam<Sides> {};

TEST_P(StretchedRows, AreOpenFoamsOperators) {
    for (const char* time_scheme : {"first-order", "second-order"})
        for (const char* scheme : {"limitedLinearV 1", "limitedLinearV 0.5", "linear",
                                   "LUST grad(U)", "linearUpwind grad(U)"}) {
            SCOPED_TRACE(std::string(time_scheme) + " " + scheme);
            CoupledSetup rows = stretched_box(GetParam());
            rows.time_scheme = time_scheme;
            rows.transport_scheme = std::string("Gauss ") + scheme;
            const CoupledSetup operators = by_operators(rows);
            CoupledRun one(rows, two_discs(rows)), other(operators, two_discs(operators));
            // So fast that the stretched rows have a flow to carry; in parts.
            for (CoupledRun* run : {&one, &other}) run->fluid().add_velocity(3.0, 1.0);
            for (int n = 0; n < 5; ++n) {
                one.advance();
                other.advance();
                EXPECT_NEAR(one.answer().report.courant, other.answer().report.courant, 1e-10);
                EXPECT_LT(one.answer().report.divergence, 1e-11);  // speeds of 3 over cells of 1/8
                EXPECT_LT(one.answer().report.momentum_defect, 1e-10);
                EXPECT_LT(other.answer().report.momentum_defect, 1e-8);
            }
            EXPECT_LT(largest_difference(one, other, {columns, rows_of_box}), 3e-10);
            EXPECT_THROW(one.fluid().restore(other.fluid().save()), Failure);  // of another kind
            const Vec3 above = one.fluid().velocity(columns / 2, rows_of_box - 4);
            EXPECT_GT(std::abs(above[0]) + std::abs(above[1]), 1e-3);  // the fluid moves there
        }
}

TEST_P(StretchedRows, GoOnFromASavedState) {
    for (const char* splitting : {"marchuk-yanenko", "implicit-multiplier"}) {
        CoupledSetup setup = stretched_box(GetParam());
        setup.splitting = splitting;
        setup.tolerance = 1e-6;
        CoupledRun straight(setup, two_discs(setup)), resumed(setup, two_discs(setup));
        resume_after_three(straight, resumed);
        advance_both(straight, resumed);
        EXPECT_EQ(largest_difference(straight, resumed, {columns, rows_of_box}), 0.0);
    }
}

INSTANTIATE_TEST_SUITE_P(Sides, StretchedRows, testing::ValuesIn(bounded_sides),
                         [](const auto& info) { return std::string(info.param.name); });

/// Centres of the rows of the box above [D].
std::vector<double> centres() {
    double ratio = 1.05;  // with which 13 rows end at 7 D; Newton's method
    const auto sum = [](double r) {
        double total = 0.0;
        for (int k = 1; k <= rows_of_box - 32; ++k) total += std::pow(r, k);
        return total / 8.0;
    };
    for (int n = 0; n < 50; ++n)
        ratio -= (sum(ratio) - 3.0) * 1e-6 / (sum(ratio + 1e-6) - sum(ratio));
    std::vector<double> all;
    double bottom = 0.0, height = 1.0 / 8.0;
    for (int j = 0; j < rows_of_box; ++j) {
        if (j >= 32) height *= ratio;
        all.push_back(bottom + 0.5 * height);
        bottom += height;
    }
    EXPECT_NEAR(bottom, 7.0, 1e-9);
    return all;
}

/// A closed box takes the momentum of a uniform stream in one window, by a pressure that is linear
/// in y: fluid under a uniform force stays at rest on rows of any heights. (The cells at a wall,
/// where p has no gradient, see half of it, on equal rows as well.)
TEST(StretchedBox, ALinearPressureIsExact) {
    for (const bool iterated : {false, true}) {
        CoupledSetup setup = stretched_box(bounded_sides[0]);
        setup.splitting = iterated ? "implicit-multiplier" : "marchuk-yanenko";
        setup.gravity = 0.0;
        setup.reynolds = 1e6;
        CoupledRun run(setup, {});
        run.fluid().add_velocity(0.0, 1.0);
        run.advance();
        for (int j = 3; j < rows_of_box - 3; ++j)
            EXPECT_NEAR(run.fluid().velocity(columns / 2, j)[1], 0.0, iterated ? 2e-4 : 1e-10);
        const double across = run.fluid().pressure(3, rows_of_box - 1) - run.fluid().pressure(3, 0);
        EXPECT_GT(across * setup.step, 6.0);
    }
}

/// A channel in which the flow has become steady.
CoupledSetup slow_channel() {
    CoupledSetup setup = stretched_box(bounded_sides[3]);
    setup.gravity = 0.0;
    setup.reynolds = 0.1;
    setup.step = 1.0;
    return setup;
}

/// The top slides: u = y/H is linear, and exact on rows of any heights.
TEST(StretchedChannel, CouetteFlowIsExact) {
    for (const bool operators : {false, true}) {
        CoupledSetup setup = slow_channel();
        setup.wall_motions = "3 constant 1.5 0 0";
        if (operators) setup = by_operators(setup);
        CoupledRun run(setup, {});
        for (int n = 0; n < 100; ++n) run.advance();
        const std::vector<double> y = centres();
        for (int j = 0; j < rows_of_box; ++j)
            EXPECT_NEAR(run.fluid().velocity(3, j)[0], 1.5 * y[j] / 7.0, 1e-8);
    }
}

/// A uniform force drives u = a y (H - y)/(2 nu), with an error of second order in the heights: on
/// equal rows a h^2/(8 nu) everywhere.
TEST(StretchedChannel, PoiseuilleFlowIsThatOfTheHeights) {
    CoupledSetup setup = slow_channel();
    setup.acceleration_x = 0.02;
    CoupledRun run(setup, {});
    for (int n = 0; n < 100; ++n) run.advance();
    const std::vector<double> y = centres();
    const double a_by_nu = setup.acceleration_x * setup.reynolds;
    const double highest = 2.0 * (7.0 - y.back()), peak = a_by_nu * 7.0 * 7.0 / 8.0;
    for (int j = 0; j < rows_of_box; ++j) {
        const double exact = 0.5 * a_by_nu * y[j] * (7.0 - y[j]);
        EXPECT_NEAR(run.fluid().velocity(3, j)[0], exact, 0.2 * a_by_nu * highest * highest);
    }
    EXPECT_LT(0.2 * a_by_nu * highest * highest, 0.01 * peak);
}

/// A single disc settles below the stretched rows as in the uniform box.
TEST(StretchedBox, ADiscBelowSettlesAsInTheUniformBox) {
    CoupledSetup stretched = stretched_box(bounded_sides[0]);
    stretched.gravity = 2.0;
    stretched.tolerance = 1e-6;
    stretched.step = 0.01;
    CoupledSetup uniform = stretched;
    uniform.stretch_ratio = 1.0;
    CoupledRun one(stretched, {disc_at(stretched, 1.69, 3.2)});
    CoupledRun other(uniform, {disc_at(uniform, 1.69, 3.2)});
    double fastest = 0.0, off = 0.0;
    for (int n = 0; n < 200; ++n) {
        one.advance();
        other.advance();
        const double v = one.grains()[0].velocity[1], w = other.grains()[0].velocity[1];
        fastest = std::max(fastest, std::abs(w));
        off = std::max(off, std::abs(v - w));
    }
    EXPECT_GT(fastest, 0.3);
    EXPECT_LT(off, 2e-3 * fastest);
    std::printf("difference %.3g of %.3g\n", off, fastest);
}

}  // namespace
}  // namespace turbidite
