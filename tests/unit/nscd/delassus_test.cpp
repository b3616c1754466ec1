// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/delassus.hpp"

#include <gtest/gtest.h>

#include <random>

#include "granular_adapter/nscd/residual.hpp"
#include "granular_adapter/nscd/solver_list.hpp"
#include "granular_adapter/nscd/vec3.hpp"

namespace turbidite::nscd {
namespace {

Contact touch(std::int32_t a, std::int32_t b, const Vec3& arm_a, const Vec3& arm_b) {
    Contact contact;
    contact.a = a;
    contact.b = b;
    contact.normal = {0.6, 0.8, 0.0};
    contact.tangent = tangent_of(contact.normal);
    contact.arm_a = arm_a;
    contact.arm_b = arm_b;
    contact.friction = 0.5;
    return contact;
}

// Discs m = 2, I = 1, R = 0.5 and m = 4, I = 8, R = 1: arms along n, so W_nn = 1/2 + 1/4 and
// W_tt = 3/4 + 0.25/1 + 1/8.
TEST(Delassus, IsDiagonalForDiscs) {
    const ContactProblem problem{{{0.5, 1.0}, {0.25, 0.125}},
                                 std::vector<Twist>(2),
                                 {touch(0, 1, {0.3, 0.4, 0.0}, {-0.6, -0.8, 0.0})}};
    const Delassus w(problem);
    EXPECT_NEAR(w.block(0).nn, 0.75, 1e-15);
    EXPECT_NEAR(w.block(0).tt, 1.125, 1e-15);
    EXPECT_EQ(w.block(0).nt, 0.0);
    EXPECT_TRUE(w.diagonal());
}

/// Bodies in a chain, arms in any direction: W_nt != 0, as polygons will have it.
ContactProblem skew_chain(int length) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> any(-0.4, 0.4);
    ContactProblem problem;
    for (int i = 0; i < length; ++i) {
        problem.bodies.push_back({1.0 + any(random), 4.0});
        problem.free.push_back({{any(random), -1.0, 0.0}, {0.0, 0.0, any(random)}});
        problem.contacts.push_back(
            touch(i - 1, i, {any(random), any(random), 0.0}, {any(random), any(random), 0.0}));
    }
    return problem;
}

// Column by column: the diagonal block of contact k is what a unit impulse at k does to k.
TEST(Delassus, BlocksAgreeWithTheOperator) {
    const ContactProblem problem = skew_chain(5);
    const Delassus w(problem);
    EXPECT_FALSE(w.diagonal());
    for (std::size_t k = 0; k < 5; ++k) {
        Impulses unit(5);
        unit[k] = {1.0, 0.0, 0.0};
        const Vec3 un = w.apply(unit)[k];
        unit[k] = {0.0, 1.0, 0.0};
        const Vec3 ut = w.apply(unit)[k];
        EXPECT_NEAR(un[0], w.block(k).nn, 1e-14);
        EXPECT_NEAR(un[1], w.block(k).nt, 1e-14);
        EXPECT_NEAR(ut[0], w.block(k).nt, 1e-14);
        EXPECT_NEAR(ut[1], w.block(k).tt, 1e-14);
    }
}

// W is symmetric: x.W y = y.W x.
TEST(Delassus, IsSymmetric) {
    const ContactProblem problem = skew_chain(6);
    const Delassus w(problem);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    Impulses x(6), y(6);
    for (std::size_t k = 0; k < 6; ++k)
        x[k] = {any(random), any(random), 0.0}, y[k] = {any(random), any(random), 0.0};
    const Impulses wx = w.apply(x), wy = w.apply(y);
    double xwy = 0.0, ywx = 0.0;
    for (std::size_t k = 0; k < 6; ++k) xwy += dot(x[k], wy[k]), ywx += dot(y[k], wx[k]);
    EXPECT_NEAR(xwy, ywx, 1e-13);
}

// The solver's path for W_nt != 0, judged by the residual alone.
TEST(Nlgs, SolvesContactsThatCoupleNormalAndTangent) {
    const ContactProblem problem = skew_chain(8);
    SolverSettings settings;
    settings.tolerance = 1e-10;
    settings.max_iterations = 100000;
    const SolverResult result = make_solver("nlgs")->solve(problem, Impulses(8), settings);
    EXPECT_TRUE(result.converged);
    EXPECT_LE(natural_map_residual(problem, result.impulses), 1e-10);
    EXPECT_EQ(natural_map_residual(problem, result.impulses), result.residual);
    EXPECT_LT(change_measures(problem, result.impulses).quad, 1e-8);
}

// Two sweeps are not enough for eight contacts in a row: the result must say so, with a residual
// above the tolerance.
TEST(Nlgs, SaysThatItDidNotConverge) {
    const ContactProblem problem = skew_chain(8);
    SolverSettings settings;
    settings.tolerance = 1e-10;
    settings.max_iterations = 2;
    const SolverResult result = make_solver("nlgs")->solve(problem, Impulses(8), settings);
    EXPECT_FALSE(result.converged);
    EXPECT_EQ(result.iterations, 2);
    EXPECT_GT(result.residual, 1e-10);
    EXPECT_EQ(natural_map_residual(problem, result.impulses), result.residual);
}

// One body, b_n = -1, W_nn = 1: the solution is r_n = 1. At r_n = 0.9, u_n = -0.1 and the map is
// r - (r - u) = -0.1, relative 0.1/0.9.
TEST(Residual, IsTheShareOfTheImpulseThatIsWrong) {
    Contact contact = touch(-1, 0, {}, {});
    const ContactProblem problem{{{1.0, 1.0}}, {{-1.0 * contact.normal, {}}}, {contact}};
    EXPECT_NEAR(natural_map_residual(problem, {{1.0, 0.0, 0.0}}), 0.0, 1e-15);
    EXPECT_NEAR(natural_map_residual(problem, {{0.9, 0.0, 0.0}}), 0.1 / 0.9, 1e-14);
}

// The same at r_n = 0.9: one update makes it 1, du = 0.1, R = 0.95, so quad = max = 0.1/0.95.
TEST(Residual, ChangeMeasuresLookAtOneUpdate) {
    Contact contact = touch(-1, 0, {}, {});
    const ContactProblem problem{{{1.0, 1.0}}, {{-1.0 * contact.normal, {}}}, {contact}};
    const ChangeMeasures change = change_measures(problem, {{0.9, 0.0, 0.0}});
    EXPECT_NEAR(change.quad, 0.1 / 0.95, 1e-14);
    EXPECT_NEAR(change.max, 0.1 / 0.95, 1e-14);
}

TEST(SolverList, NamesTheKnownSolversWhenAskedForAnother) {
    try {
        make_solver("newton");
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("known: nlgs"), std::string::npos);
    }
}

}  // namespace
}  // namespace turbidite::nscd
