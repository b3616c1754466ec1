// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Momentum between sweeps: a tall stack feels its load sooner, with the same solution, and where
// momentum does not help it is given up.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

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

// A problem of many stretches, of which each waits for the bodies that it shares with others.
TEST(Momentum, HasTheSameBitsOnAnyNumberOfThreads) {
    const ContactProblem problem = stack(7000);
    const auto impulses = [&](std::int64_t momentum_after, std::int64_t threads) {
        const SolverSettings settings{.tolerance = 1e-12,
                                      .max_iterations = 64,
                                      .momentum_after = momentum_after,
                                      .threads = threads};
        return Nlgs().solve(problem, Impulses(problem.contacts.size()), settings).impulses;
    };
    const Impulses one = impulses(16, 1), three = impulses(16, 3);
    for (std::size_t i = 0; i < one.size(); ++i) ASSERT_EQ(one[i].n, three[i].n) << i;
    EXPECT_GT(one[0].n, 1.2 * impulses(never, 1)[0].n);
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

/// By sweep, in checks of eight: whether it has momentum, while `fall` times the error is left
/// after each check.
std::vector<bool> with_momentum(MomentumPhases phases, double fall_with, double fall_without) {
    std::vector<bool> result;
    double error = 1.0;
    for (std::int64_t sweeps = 8; sweeps <= 80000; sweeps += 8) {
        result.insert(result.end(), 8, phases.with_momentum());
        error *= phases.with_momentum() ? fall_with : fall_without;
        phases.check(sweeps, error);
    }
    return result;
}

std::ptrdiff_t count(const std::vector<bool>& sweeps) {
    return std::count(sweeps.begin(), sweeps.end(), true);
}

/// Lengths of runs of equal values, the first `n`.
std::vector<int> lengths(const std::vector<bool>& sweeps, std::size_t n) {
    std::vector<int> result{0};
    for (std::size_t i = 0; i < sweeps.size() && result.size() <= n; ++i) {
        if (i > 0 && sweeps[i] != sweeps[i - 1]) result.push_back(0);
        ++result.back();
    }
    result.resize(n);
    return result;
}

TEST(MomentumPhases, CyclesAreShortWhereTheseTakeAQuarterOffTheError) {
    const std::vector<bool> sweeps = with_momentum(MomentumPhases(16), 0.9, 0.9);
    EXPECT_EQ(lengths(sweeps, 7), (std::vector<int>{16, 24, 8, 24, 8, 24, 8}));
    EXPECT_EQ(lengths(with_momentum(MomentumPhases(16), 0.95, 0.9), 5),
              (std::vector<int>{16, 24, 8, 112, 16}));
}

// Errors that grow in a cycle, and are the smaller at its end.
TEST(MomentumPhases, LongCyclesGoOnAsLongAsTheyHelp) {
    const std::vector<bool> sweeps = with_momentum(MomentumPhases(16), 1.01, 0.8);
    EXPECT_EQ(lengths(sweeps, 8), (std::vector<int>{16, 24, 8, 112, 16, 112, 16, 112}));
    EXPECT_GT(count(sweeps), 0.8 * static_cast<double>(sweeps.size()));
}

TEST(MomentumPhases, GiveMomentumUpWhereItDoesNotHelp) {
    const std::vector<bool> sweeps = with_momentum(MomentumPhases(16), 2.0, 0.9);
    const std::vector<int> pause = lengths(sweeps, 13);
    EXPECT_EQ(pause,
              (std::vector<int>{16, 24, 8, 112, 16, 24, 8 + 128, 24, 8, 112, 16, 24, 8 + 256}));
    EXPECT_LT(count(sweeps), 0.05 * static_cast<double>(sweeps.size()));
}

}  // namespace
}  // namespace turbidite::nscd
