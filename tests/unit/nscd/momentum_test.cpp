// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Momentum between sweeps: a tall stack feels its load sooner, with the same solution, and where
// momentum does not help it is given up.
#include <gtest/gtest.h>

#include "granular_adapter/nscd/problem/residual.hpp"
#include "granular_adapter/nscd/solvers/momentum_phases.hpp"
#include "granular_adapter/nscd/solvers/nlgs.hpp"
#include "planar.hpp"

namespace turbidite::nscd {
namespace {

constexpr double weight = 0.01;  // of a body in a step [N s]

/// n bodies of mass 1 on each other and on a floor, listed so that sweeps go against the load.
ContactProblem stack(int n) {
    ContactProblem problem;
    for (int i = 0; i < n; ++i) {
        planar::bodies(problem).push_back(BodyMobility(1.0, 8.0));
        problem.free.push_back({{0, -weight, 0}, {}});
        Contact c;
        c.a = i - 1, c.b = i;
        c.normal = {0, 1, 0}, c.tangent = tangent_of(c.normal);
        c.arm_b = {0, -0.5, 0};
        if (i > 0) c.arm_a = {0, 0.5, 0};
        c.friction = 0.3;
        problem.contacts.push_back(c);
    }
    return problem;
}

SolverResult solve(const ContactProblem& problem, std::int64_t momentum_after, double tolerance) {
    const SolverSettings settings{
        .tolerance = tolerance, .max_iterations = 100000, .momentum_after = momentum_after};
    return Nlgs().solve(problem, Impulses(problem.contacts.size()), settings);
}

constexpr std::int64_t never = SolverSettings().momentum_after;

TEST(Momentum, ATallStackFeelsItsLoadInAFifthOfTheSweeps) {
    constexpr int n = 100;
    const ContactProblem problem = stack(n);
    const SolverResult with = solve(problem, 16, 1e-6), without = solve(problem, never, 1e-6);
    EXPECT_TRUE(with.converged);
    EXPECT_TRUE(without.converged);
    EXPECT_LT(5 * with.iterations, without.iterations);
    EXPECT_LE(natural_map_residual(problem, with.impulses), 1e-6);
    // Contact i carries the bodies above it.
    for (int i = 0; i < n; ++i)
        EXPECT_NEAR(with.impulses[i].n, (n - i) * weight, 0.01 * n * weight) << i;
}

TEST(Momentum, BothReachTightTolerances) {
    const ContactProblem problem = stack(30);
    const SolverResult with = solve(problem, 16, 1e-12), without = solve(problem, never, 1e-12);
    EXPECT_TRUE(with.converged);
    EXPECT_LT(with.iterations, without.iterations);
    for (int i = 0; i < 30; ++i) {
        EXPECT_NEAR(with.impulses[i].n, (30 - i) * weight, 1e-9);
        EXPECT_NEAR(without.impulses[i].n, (30 - i) * weight, 1e-9);
    }
}

TEST(Momentum, IsNotInTheFirstSweeps) {
    const ContactProblem problem = stack(100);
    const auto after = [&](std::int64_t sweeps, std::int64_t momentum_after) {
        const SolverSettings settings{
            .tolerance = 1e-12, .max_iterations = sweeps, .momentum_after = momentum_after};
        return Nlgs().solve(problem, Impulses(problem.contacts.size()), settings).impulses[50].n;
    };
    EXPECT_EQ(after(16, 16), after(16, never));
    EXPECT_NE(after(32, 16), after(32, never));
}

// The error falls by a tenth in eight plain sweeps, and grows with momentum.
TEST(MomentumPhases, GiveMomentumUpWhereItDoesNotHelp) {
    MomentumPhases phases(16);
    double error = 1.0;
    int with = 0, checks = 0;
    for (std::int64_t sweeps = 8; sweeps <= 80000; sweeps += 8, ++checks) {
        error *= phases.with_momentum() ? 2.0 : 0.9;
        with += phases.with_momentum() ? 1 : 0;
        phases.check(sweeps, error);
    }
    EXPECT_GE(with, 2);
    EXPECT_LT(with, 20);
    EXPECT_EQ(checks, 10000);
}

// Momentum that helps begins anew at once where the error grows, and goes on.
TEST(MomentumPhases, KeepMomentumThatHelps) {
    MomentumPhases phases(16);
    double error = 1.0;
    int with = 0, checks = 0;
    for (std::int64_t sweeps = 8; sweeps <= 800; sweeps += 8, ++checks) {
        const bool grows = checks % 10 == 9;
        error *= !phases.with_momentum() ? 0.99 : grows ? 1.6 : 0.8;
        with += phases.with_momentum() ? 1 : 0;
        phases.check(sweeps, error);
    }
    EXPECT_GT(with, 80);
}

}  // namespace
}  // namespace turbidite::nscd
