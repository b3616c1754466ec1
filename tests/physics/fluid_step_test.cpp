// SPDX-License-Identifier: GPL-3.0-or-later
//
// Steps 1 to 3 on the rows of a box (a row is the cells of one y) against the same steps by
// OpenFOAM's operators, and the behaviour of explicit transport beyond dt = 2 nu/u2.
//
// `bounded` subtracts u div phi from the transport, which is rounding after a direct projection:
// the result is the same, but only OpenFOAM's table has this scheme, so its operators are used.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fluid_adapter/box_step/transport/transport_parts.hpp"
#include "tests/physics/coupled_run.hpp"

namespace turbidite {
namespace {

constexpr Sides all_sides[] = {
    {"closed", "wall", "wall", "wall", "wall"},
    {"freeRightAndTop", "wall", "free", "wall", "free"},
    {"freeLeftAndBottom", "free", "wall", "free", "wall"},
    {"channel", "cyclic", "cyclic", "wall", "wall"},
    {"chimney", "wall", "free", "cyclic", "cyclic"},
    {"cyclic", "cyclic", "cyclic", "cyclic", "cyclic"},
};

constexpr int nx = 27, ny = 34;  // odd and even: transforms process rows in pairs

CoupledSetup box_with(const Sides& sides, bool operators, const std::string& k) {
    CoupledSetup setup = with_sides(sides);
    setup.cells_per_diameter = 8;
    setup.width = nx / 8.0;
    setup.height = ny / 8.0;
    setup.step = 0.02;
    setup.gravity = 11.86;
    setup.tolerance = 1e-9;
    setup.transport_scheme = std::string(operators ? "bounded " : "") + "Gauss limitedLinearV " + k;
    return setup;
}

std::vector<GrainState> two_discs(const CoupledSetup& setup) {
    return {disc_at(setup, 1.13, 1.02, 0.3, -0.2), disc_at(setup, 2.27, 2.9, -0.4, 0.1)};
}

/// Rounding, 1e-16, over ten windows, amplified by solves of condition about 1e3 and by conjugate
/// gradients.
constexpr double rounding = 1e-11;

class FluidSteps : public testing::TestWithParam<Sides> {};

TEST_P(FluidSteps, OnRowsAreOpenFoamsOperators) {
    for (const char* k : {"1", "0.5"}) {
        const CoupledSetup rows = box_with(GetParam(), false, k);
        const CoupledSetup operators = box_with(GetParam(), true, k);
        CoupledRun one(rows, two_discs(rows)), other(operators, two_discs(operators));
        for (int n = 0; n < 10; ++n) {
            one.advance();
            other.advance();
            EXPECT_NEAR(one.answer().report.courant, other.answer().report.courant, rounding);
            EXPECT_LT(one.answer().report.divergence, 1e-12);
            EXPECT_LT(one.answer().report.momentum_defect, 1e-10);
        }
        EXPECT_LT(largest_difference(one, other, {nx, ny}), rounding);
        EXPECT_GT(one.answer().report.courant, 0.02);  // the fluid moves
    }
}

/// The same in second order, with every scheme that rows know, in windows that transport divides
/// too; with viscosity as part of transport (nu dt/h2 = 0.013) and as a step of its own (1.3).
class SecondOrderSteps : public testing::TestWithParam<std::tuple<Sides, double>> {};

TEST_P(SecondOrderSteps, AreOpenFoamsOperators) {
    const auto [sides, reynolds] = GetParam();
    for (const std::string scheme :
         {"LUST grad(U)", "linearUpwind grad(U)", "linear", "limitedLinearV 1"}) {
        SCOPED_TRACE(scheme);
        CoupledSetup rows = box_with(sides, false, "1");
        rows.time_scheme = "second-order";
        rows.reynolds = reynolds;
        CoupledSetup operators = rows;
        rows.transport_scheme = "Gauss " + scheme;
        operators.transport_scheme = "bounded Gauss " + scheme;
        CoupledRun one(rows, two_discs(rows)), other(operators, two_discs(operators));
        const double speed = 1.5 / (rows.step * 8.0);  // cells per window
        for (CoupledRun* run : {&one, &other}) run->fluid().add_velocity(speed, 0.3 * speed);
        for (int n = 0; n < 6; ++n) {
            one.advance();
            other.advance();
            EXPECT_LT(one.answer().report.momentum_defect, 1e-10);
            EXPECT_LT(other.answer().report.momentum_defect, 1e-8);
        }
        EXPECT_LT(largest_difference(one, other, {nx, ny}), 100.0 * rounding);  // speeds of ten
    }
}

INSTANTIATE_TEST_SUITE_P(Sides, SecondOrderSteps,
                         testing::Combine(testing::ValuesIn(all_sides),
                                          testing::Values(100.0, 1.0)),
                         [](const auto& info) {
                             return std::string(std::get<0>(info.param).name) +
                                    (std::get<1>(info.param) > 10.0 ? "" : "Viscous");
                         });

/// The steps' own state is part of the saved state: after restoring it, a fluid that took another
/// course continues bit for bit as the one that was saved.
TEST_P(FluidSteps, GoOnFromASavedState) {
    for (const bool by_operators : {false, true})
        for (const char* time_scheme : {"first-order", "second-order"}) {
            CoupledSetup setup = box_with(GetParam(), by_operators, "1");
            setup.time_scheme = time_scheme;
            CoupledRun straight(setup, two_discs(setup)), resumed(setup, two_discs(setup));
            resume_after_three(straight, resumed);
            EXPECT_EQ(largest_difference(straight, resumed, {nx, ny}), 0.0);
            advance_both(straight, resumed);
            EXPECT_EQ(largest_difference(straight, resumed, {nx, ny}), 0.0);
        }
}

TEST(FluidStep, RefusesTheSavedStateOfAnotherOrder) {
    CoupledSetup first = box_with(all_sides[0], false, "1"), second = first;
    second.time_scheme = "second-order";
    CoupledRun one(first, two_discs(first)), other(second, two_discs(second));
    EXPECT_THROW(one.fluid().restore(other.fluid().save()), Failure);
    EXPECT_THROW(other.fluid().restore(one.fluid().save()), Failure);
}

TEST(FluidStep, RefusesTheSavedStateOfAnotherKind) {
    const CoupledSetup rows = box_with(all_sides[0], false, "1");
    const CoupledSetup operators = box_with(all_sides[0], true, "1");
    CoupledRun one(rows, two_discs(rows)), other(operators, two_discs(operators));
    EXPECT_THROW(one.fluid().restore(other.fluid().save()), Failure);
    EXPECT_THROW(other.fluid().restore(one.fluid().save()), Failure);
}

INSTANTIATE_TEST_SUITE_P(Sides, FluidSteps, testing::ValuesIn(all_sides),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(TransportParts, KeepEveryPartBelowTwoThirds) {
    EXPECT_EQ(transport_parts(0.0), 1);
    EXPECT_EQ(transport_parts(0.66), 1);
    EXPECT_EQ(transport_parts(0.67), 2);
    EXPECT_EQ(transport_parts(2.1), 4);
    EXPECT_EQ(transport_parts(std::numeric_limits<double>::quiet_NaN()), 1);  // refused elsewhere
}

/// Beyond a Courant number of 2/3 transport is divided into sub-steps; both kinds of steps still
/// agree, momentum balances on open sides too, and u stays bounded.
TEST_P(FluidSteps, TakeLongStepsInParts) {
    CoupledSetup rows = box_with(GetParam(), false, "1"),
                 operators = box_with(GetParam(), true, "1");
    CoupledRun one(rows, two_discs(rows)), other(operators, two_discs(operators));
    const double speed = 2.0 / (rows.step * 8.0);  // at least 2 cells per window
    for (CoupledRun* run : {&one, &other}) run->fluid().add_velocity(speed, 0.3 * speed);
    double courant = 0.0;
    for (int n = 0; n < 6; ++n) {
        one.advance();
        other.advance();
        courant = std::max(courant, one.answer().report.courant);
        EXPECT_LT(one.answer().report.momentum_defect, 1e-10);
        EXPECT_LT(other.answer().report.momentum_defect, 1e-8);
    }
    // A closed box stops the stream immediately.
    if (std::string(GetParam().name) != "closed") {
        EXPECT_GT(courant, 2.0 / 3.0);
    }
    EXPECT_LT(largest_difference(one, other, {nx, ny}), rounding * speed * 10.0);
}

/// A stream past a disc in a cyclic box, with a step 25 times the limit 2 nu/u2 = 0.002.
CoupledSetup stream_beyond_the_limit(const std::string& scheme) {
    CoupledSetup setup = box_with(all_sides[5], false, "1");
    setup.reynolds = 1000.0;
    setup.step = 0.05;
    setup.gravity = 0.0;
    setup.tolerance = 1e-4;
    setup.transport_scheme = scheme;
    return setup;
}

/// Largest |u_x| during the run; infinity if a window is refused.
double fastest(const CoupledSetup& setup, int windows) try {
    CoupledRun run(setup, {disc_at(setup, 1.63, 2.017)});
    run.fluid().add_velocity(1.0, 0.3);
    double largest = 0.0;
    for (int n = 0; n < windows; ++n) {
        run.advance();
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
                largest = std::max(largest, std::abs(run.fluid().velocity(i, j)[0]));
    }
    return largest;
} catch (const PhysicsRefused&) {
    return INFINITY;
}

TEST(ExplicitTransport, InFirstOrderIsBoundedWithTheLimitedSchemeAndNotWithCentralOnes) {
    EXPECT_LT(fastest(stream_beyond_the_limit("Gauss limitedLinearV 1"), 150), 1.5);
    EXPECT_GT(fastest(stream_beyond_the_limit("Gauss linear"), 150), 10.0);
    EXPECT_GT(fastest(stream_beyond_the_limit("Gauss cubic"), 150), 10.0);
}

/// In second order no scheme is bounded, and none grows: the same stream, 25 times beyond the limit
/// of first order.
TEST(ExplicitTransport, OfSecondOrderDoesNotGrow) {
    for (const char* scheme :
         {"Gauss limitedLinearV 1", "Gauss LUST grad(U)", "Gauss linearUpwind grad(U)"}) {
        CoupledSetup setup = stream_beyond_the_limit(scheme);
        setup.time_scheme = "second-order";
        EXPECT_LT(fastest(setup, 150), 2.0) << scheme;
    }
}

}  // namespace
}  // namespace turbidite
