// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Requirements on every solver, and on the reference for them.
#include <gtest/gtest.h>

#include <cstring>

#include "granular_adapter/nscd/problem/plane/delassus_matrix.hpp"
#include "granular_adapter/nscd/problem/residual.hpp"
#include "planar.hpp"
#include "problems.hpp"
#include "scenes.hpp"
#include "tests/oracle/nlgs_stored.hpp"

namespace turbidite::nscd {
namespace {

using problems::random_problem;

SolverSettings tight(double tolerance = 1e-10) {
    SolverSettings settings;
    settings.tolerance = tolerance;
    settings.max_iterations = 200000;
    return settings;
}

SolverResult solve(const std::string& solver, const ContactProblem& problem,
                   const SolverSettings& settings) {
    return make_solver(solver, solvers_and_reference())
        ->solve(problem, Impulses(problem.contacts.size()), settings);
}

bool same_bits(const Impulses& a, const Impulses& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

/// A load on a floor and against two walls, at rest: hyperstatic, W is singular.
ContactProblem settled_problem() {
    EngineSettings settings = scenes::exact(0.3, 1e-6);
    Engine engine = scenes::settling_pack(8, 8, settings);
    scenes::run(engine, 6.0, 0.02);
    engine.step(0.02);
    return engine.problem();
}

/// The dry column after `steps` of 0.01: touching discs D = 1, a left wall and a floor, mu = 0.3.
ContactProblem young_lattice(int columns, int rows, int steps) {
    EngineSettings settings = scenes::exact(0.3, 1e-3);
    settings.solver_settings.max_iterations = 5000;
    Engine engine(settings, scenes::discs,
                  {scenes::floor(0.3), scenes::wall(2, {0, 0, 0}, {1, 0, 0}, 0.3)});
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns - row % 2; ++column)
            engine.bodies().add(scenes::disc(100 * row + column, 0.5 + column + 0.5 * (row % 2),
                                             0.5 + row * std::sqrt(0.75)));
    scenes::run(engine, 0.01 * (steps - 1), 0.01);
    engine.step(0.01);
    return engine.problem();
}

class EverySolver : public testing::TestWithParam<std::string> {};

TEST_P(EverySolver, SolvesProblemsWithAnyMobilityAndArms) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        const ContactProblem problem = random_problem({.dragging = seed % 2 == 0, .seed = seed});
        const SolverResult result = solve(GetParam(), problem, tight());
        EXPECT_TRUE(result.converged) << "seed " << seed << ", residual " << result.residual;
        EXPECT_LE(natural_map_residual(problem, result.impulses), 1e-10);
        EXPECT_EQ(natural_map_residual(problem, result.impulses), result.residual);
        for (std::size_t k = 0; k < problem.contacts.size(); ++k) {
            const ContactVector& r = result.impulses[k];
            EXPECT_GE(r.n, 0.0);
            EXPECT_LE(std::abs(r.t), problem.contacts[k].friction * r.n * (1.0 + 1e-15));
        }
    }
}

TEST_P(EverySolver, SolvesASettledPacking) {
    const ContactProblem problem = settled_problem();
    ASSERT_GT(problem.contacts.size(), 100u);
    const SolverResult result = solve(GetParam(), problem, tight(1e-6));
    EXPECT_TRUE(result.converged) << result.residual;
    EXPECT_LE(natural_map_residual(problem, result.impulses), 1e-6);
}

TEST_P(EverySolver, FindsTheVelocitiesOfNlgs) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const ContactProblem problem = random_problem({.friction = 0.5, .seed = seed});
        const SolverResult a = solve("nlgs", problem, tight(1e-12));
        const SolverResult b = solve(GetParam(), problem, tight(1e-12));
        for (std::size_t i = 0; i < size(problem.bodies); ++i) {
            EXPECT_LT(norm(a.velocities[i].velocity - b.velocities[i].velocity), 1e-9);
            EXPECT_NEAR(a.velocities[i].spin[2], b.velocities[i].spin[2], 1e-9);
        }
    }
}

TEST_P(EverySolver, GivesTheVelocitiesOfItsImpulses) {
    const ContactProblem problem = random_problem({.seed = 7});
    for (const std::int64_t most : {1, 100000}) {
        SolverSettings settings = tight();
        settings.max_iterations = most;
        const SolverResult result = solve(GetParam(), problem, settings);
        const std::vector<Twist> v = body_velocities(problem, result.impulses);
        for (std::size_t i = 0; i < v.size(); ++i) {
            EXPECT_LT(norm(v[i].velocity - result.velocities[i].velocity), 1e-13);
            EXPECT_LT(norm(v[i].spin - result.velocities[i].spin), 1e-13);
        }
    }
}

TEST_P(EverySolver, SaysThatItDidNotConverge) {
    const ContactProblem problem = settled_problem();
    SolverSettings settings = tight();
    settings.max_iterations = 3;
    const SolverResult result = solve(GetParam(), problem, settings);
    EXPECT_FALSE(result.converged);
    EXPECT_EQ(result.iterations, 3);
    EXPECT_GT(result.residual, 1e-10);
    EXPECT_EQ(natural_map_residual(problem, result.impulses), result.residual);
    EXPECT_GT(result.change.max, 0.0);
}

TEST_P(EverySolver, StartsFromTheGuess) {
    const ContactProblem problem = settled_problem();
    const auto solver = make_solver(GetParam(), solvers_and_reference());
    const SolverResult cold = solve(GetParam(), problem, tight(1e-6));
    const SolverResult warm = solver->solve(problem, cold.impulses, tight(1e-6));
    EXPECT_LE(warm.iterations, 1);
    EXPECT_TRUE(warm.converged);
}

TEST_P(EverySolver, GivesTheSameBitsTwice) {
    const ContactProblem problem = settled_problem();
    const SolverResult a = solve(GetParam(), problem, tight(1e-6));
    const SolverResult b = solve(GetParam(), problem, tight(1e-6));
    EXPECT_EQ(a.iterations, b.iterations);
    EXPECT_TRUE(same_bits(a.impulses, b.impulses));
}

TEST_P(EverySolver, HasNothingToDoWithoutContacts) {
    ContactProblem problem;
    problem.bodies = std::vector<PlanarTensor>{{1.0, 1.0}};
    problem.free = {{{1.0, 2.0, 0.0}, {}}};
    const SolverResult result = solve(GetParam(), problem, tight());
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.velocities[0].velocity, (Vec3{1.0, 2.0, 0.0}));
}

TEST_P(EverySolver, RefusesSettingsThatMeanNothing) {
    SolverSettings settings;
    settings.tolerance = 0.0;
    EXPECT_THROW(solve(GetParam(), random_problem({}), settings), std::invalid_argument);
}

std::vector<std::string> names() {
    std::vector<std::string> result;
    for (const SolverEntry& entry : solvers_and_reference()) result.push_back(entry.name);
    return result;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    for (char& c : name)
        if (c == '-') c = '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(Solvers, EverySolver, testing::ValuesIn(names()), test_name);

// Gauss-Seidel by dense algebra, contact by contact in the order given.
TEST(NlgsStored, SweepsInTheOrderOfTheContacts) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const ContactProblem problem = random_problem({.seed = seed});
        const Eigen::MatrixXd w = problems::dense_delassus(problem);
        const std::vector<Plane> free = free_contact_velocities(problem);
        Eigen::VectorXd r = Eigen::VectorXd::Zero(w.rows());
        for (std::int64_t sweep = 1; sweep <= 3; ++sweep) {
            for (std::size_t k = 0; k < free.size(); ++k) {
                r.segment<2>(2 * k).setZero();
                const Eigen::Vector2d b = w.middleRows<2>(2 * k) * r;
                const Block own{w(2 * k, 2 * k), w(2 * k, 2 * k + 1), w(2 * k + 1, 2 * k + 1)};
                const Plane next = solve_contact(own, {b[0] + free[k][0], b[1] + free[k][1]},
                                                 problem.contacts[k].friction);
                r.segment<2>(2 * k) << next[0], next[1];
            }
            SolverSettings settings = tight();
            settings.max_iterations = sweep;
            const SolverResult result = solve("nlgs-stored", problem, settings);
            for (std::size_t k = 0; k < free.size(); ++k)
                for (int d = 0; d < 2; ++d)
                    EXPECT_NEAR(planar::component(result.impulses[k], d), r[2 * k + d],
                                1e-12 * r.norm());
        }
    }
}

TEST(NlgsStored, RefusesRollingByName) {
    const ContactProblem problem = random_problem({.rolling = 0.1});
    try {
        solve("nlgs-stored", problem, tight());
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("nlgs-stored"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("rolling"), std::string::npos);
    }
}

// On this packing sweeps stall between 1e-7 and 1e-8.
TEST(CentralPath, SolvesASettledPackingToEightDigits) {
    const ContactProblem problem = settled_problem();
    const SolverResult result = solve("central-path", problem, tight(1e-8));
    EXPECT_TRUE(result.converged) << result.residual;
    EXPECT_LE(natural_map_residual(problem, result.impulses), 1e-8);
}

// A perfect triangular lattice against a wall that has just begun to fall. Sweeps, and Newton
// methods started where they stall, remain at 1e-3, since the path to the solution has several
// turning points in z.
TEST(CentralPath, SolvesPerfectLatticesThatHaveHardlyMoved) {
    for (const int steps : {2, 20, 40}) {
        const ContactProblem problem = young_lattice(8, 17, steps);
        ASSERT_GT(problem.contacts.size(), 300u);
        SolverSettings settings = tight(1e-8);
        settings.max_iterations = 20000;
        EXPECT_GT(solve("nlgs", problem, settings).residual, 1e-5);
        settings.max_iterations = 1000000;
        const SolverResult result = solve("central-path", problem, settings);
        EXPECT_TRUE(result.converged) << "after " << steps << " steps: " << result.residual;
        EXPECT_LE(natural_map_residual(problem, result.impulses), 1e-8);
    }
}

// The paper's column at 14 x 28 D after 0.1 t_c. A path that starts at Coulomb's law has about a
// hundred turning points here and is not complete after 10,000 iterations, nor after 30,000 on the
// column of bench/contact/tight_column.cpp.
TEST(CentralPath, TakesFewIterationsOnALargerYoungLattice) {
    const ContactProblem problem = young_lattice(14, 32, 11);
    ASSERT_GT(problem.contacts.size(), 1200u);
    SolverSettings settings = tight(1e-8);
    settings.max_iterations = 10000;
    EXPECT_GT(solve("nlgs", problem, settings).residual, 1e-5);
    const SolverResult result = solve("central-path", problem, settings);
    EXPECT_TRUE(result.converged) << result.residual;
    EXPECT_GT(result.iterations, 8000);
    EXPECT_LE(natural_map_residual(problem, result.impulses), 1e-8);
}

TEST(CentralPath, GivesTheSameBitsTwiceAfterALongPath) {
    const ContactProblem problem = young_lattice(8, 17, 40);
    SolverSettings settings = tight(1e-8);
    settings.max_iterations = 1000000;
    const SolverResult a = solve("central-path", problem, settings);
    const SolverResult b = solve("central-path", problem, settings);
    EXPECT_GT(a.iterations, 8000);
    EXPECT_EQ(a.iterations, b.iterations);
    EXPECT_TRUE(same_bits(a.impulses, b.impulses));
}

/// Contacts with an impulse, and those of them that slide.
std::array<std::size_t, 2> loaded_and_sliding(const ContactProblem& problem, const Impulses& r) {
    std::array<std::size_t, 2> count{};
    for (std::size_t k = 0; k < r.size(); ++k) {
        if (r[k].n == 0.0) continue;
        ++count[0];
        count[1] += std::abs(r[k].t) >= (1.0 - 1e-9) * problem.contacts[k].friction * r[k].n;
    }
    return count;
}

// Points of a path are inside all cones, where laws and reports would find every contact loaded and
// none that slides.
TEST(CentralPath, GivesOpenContactsNoImpulseAndSlidingOnesAllOfTheirFriction) {
    const ContactProblem problem = young_lattice(8, 17, 20);
    SolverSettings settings = tight(1e-10);
    settings.max_iterations = 1000000;
    const SolverResult exact = solve("central-path", problem, settings);
    const auto [loaded, sliding] = loaded_and_sliding(problem, exact.impulses);
    ASSERT_GT(loaded, 50u);
    ASSERT_GT(sliding, 5u);
    ASSERT_LT(loaded + 20, problem.contacts.size());
    for (const double tolerance : {1e-3, 1e-4, 1e-6}) {
        settings.tolerance = tolerance;
        const SolverResult result = solve("central-path", problem, settings);
        EXPECT_TRUE(result.converged);
        EXPECT_LE(natural_map_residual(problem, result.impulses), tolerance);
        const auto [some, slide] = loaded_and_sliding(problem, result.impulses);
        std::printf("tolerance %.0e: %ld iterations, %zu of %zu loaded (%zu), %zu sliding (%zu)\n",
                    tolerance, static_cast<long>(result.iterations), some, problem.contacts.size(),
                    loaded, slide, sliding);
        EXPECT_NEAR(static_cast<double>(some), static_cast<double>(loaded), 0.1 * loaded);
        EXPECT_GT(slide, sliding / 2);
    }
}

TEST(CentralPath, SolvesRollingResistance) {
    const ContactProblem problem = random_problem({.rolling = 0.1, .seed = 4});
    const SolverResult result = solve("central-path", problem, tight());
    EXPECT_TRUE(result.converged) << result.residual;
}

// Blocks of contacts that share one body, two bodies, or no movable body.
TEST(DelassusMatrix, IsTheDenseProduct) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const ContactProblem problem =
            random_problem({.bodies = 6, .extra_contacts = 12, .seed = seed});
        const Eigen::MatrixXd reference = problems::dense_delassus(problem);
        const DelassusMatrix w(problem);
        Eigen::MatrixXd found = Eigen::MatrixXd::Zero(reference.rows(), reference.cols());
        for (std::size_t k = 0; k < w.size(); ++k) {
            const Block& own = w.diagonal[k];
            found.block<2, 2>(2 * k, 2 * k) << own.nn, own.nt, own.nt, own.tt;
            for (std::int64_t e = w.row_start[k]; e < w.row_start[k + 1]; ++e) {
                const Coupling& c = w.coupling[e];
                found.block<2, 2>(2 * k, 2 * w.column[e]) << c.by_n[0], c.by_t[0], c.by_n[1],
                    c.by_t[1];
            }
        }
        EXPECT_LT((found - reference).norm(), 1e-13 * reference.norm());
        EXPECT_EQ((found - found.transpose()).norm(), 0.0);
    }
}

}  // namespace
}  // namespace turbidite::nscd
