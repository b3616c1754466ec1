// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/plane/delassus.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/problem/residual.hpp"
#include "granular_adapter/nscd/solvers/solver_list.hpp"
#include "planar.hpp"
#include "problems.hpp"

namespace turbidite::nscd {
namespace {

using planar::component;

using problems::dense;
using problems::dense_delassus;

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
    const ContactProblem problem{std::vector<PlanarTensor>{{0.5, 1.0}, {0.25, 0.125}},
                                 std::vector<Twist>(2),
                                 {touch(0, 1, {0.3, 0.4, 0.0}, {-0.6, -0.8, 0.0})}};
    const Delassus w(problem);
    EXPECT_NEAR(w.block(0).nn, 0.75, 1e-15);
    EXPECT_NEAR(w.block(0).tt, 1.125, 1e-15);
    EXPECT_EQ(w.block(0).nt, 0.0);
    EXPECT_TRUE(w.diagonal());
}

/// Bodies in a chain with arms in any direction: W_nt != 0, as for polygons.
ContactProblem skew_chain(int length) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> any(-0.4, 0.4);
    ContactProblem problem;
    for (int i = 0; i < length; ++i) {
        planar::bodies(problem).push_back({1.0 + any(random), 4.0});
        problem.free.push_back({{any(random), -1.0, 0.0}, {0.0, 0.0, any(random)}});
        problem.contacts.push_back(
            touch(i - 1, i, {any(random), any(random), 0.0}, {any(random), any(random), 0.0}));
    }
    return problem;
}

/// Effective inertia A = B^T B + diag(m, m, I): positive definite, mass and spin coupled.
PlanarTensor random_inertia(std::mt19937_64& random) {
    std::uniform_real_distribution<double> any(-0.5, 0.5);
    Eigen::Matrix3d b;
    for (int i = 0; i < 9; ++i) b(i) = any(random);
    const Eigen::Matrix3d a =
        b.transpose() * b + Eigen::Vector3d(1.0, 1.0, 0.2).asDiagonal().toDenseMatrix();
    return problems::planar(a);
}

/// The same chain with tied fluid at the bodies; `inertia` receives their A.
ContactProblem wet_chain(int length, std::vector<PlanarTensor>& inertia) {
    ContactProblem problem = skew_chain(length);
    std::mt19937_64 random(11);
    for (BodyMobility& body : planar::bodies(problem)) {
        inertia.push_back(random_inertia(random));
        body = inverse(inertia.back()).value();
    }
    return problem;
}

TEST(Mobility, IsTheInverseOfTheInertia) {
    std::mt19937_64 random(2);
    for (int i = 0; i < 20; ++i) {
        const PlanarTensor inertia = random_inertia(random);
        const Eigen::Matrix3d product = dense(inertia) * dense(inverse(inertia).value());
        EXPECT_LT((product - Eigen::Matrix3d::Identity()).norm(), 1e-13);
    }
    const BodyMobility simple = inverse(PlanarTensor(3.0, 7.0)).value();
    EXPECT_TRUE(simple.isotropic());
    EXPECT_EQ(simple.xx, 1.0 / 3.0);
    EXPECT_EQ(simple.ss, 1.0 / 7.0);
}

// Indefinite although every diagonal entry is positive; singular; NaN.
TEST(Mobility, NeedsAPositiveDefiniteInertia) {
    PlanarTensor coupled(1.0, 1.0);
    coupled.xs = 1.5;
    EXPECT_FALSE(inverse(coupled));
    coupled.xs = 1.0;
    EXPECT_FALSE(inverse(coupled));
    EXPECT_FALSE(inverse(PlanarTensor(-1.0, 1.0)));
    EXPECT_FALSE(inverse(PlanarTensor(1.0, 0.0)));
    EXPECT_FALSE(inverse(PlanarTensor(NAN, 1.0)));
}

TEST(Delassus, IsTheDenseProductForAnyMobility) {
    std::vector<PlanarTensor> inertia;
    const ContactProblem problem = wet_chain(6, inertia);
    const Eigen::MatrixXd reference = dense_delassus(problem);
    EXPECT_LT((reference - reference.transpose()).norm(), 1e-14);
    const Delassus w(problem);
    EXPECT_FALSE(w.diagonal());
    for (int k = 0; k < 6; ++k) {
        EXPECT_NEAR(w.block(k).nn, reference(2 * k, 2 * k), 1e-14);
        EXPECT_NEAR(w.block(k).nt, reference(2 * k, 2 * k + 1), 1e-14);
        EXPECT_NEAR(w.block(k).tt, reference(2 * k + 1, 2 * k + 1), 1e-14);
        for (int d = 0; d < 2; ++d) {
            Impulses unit(6);
            component(unit[k], d) = 1.0;
            const Impulses column = w.apply(unit);
            for (int j = 0; j < 6; ++j)
                for (int e = 0; e < 2; ++e)
                    EXPECT_NEAR(component(column[j], e), reference(2 * j + e, 2 * k + d), 1e-14);
        }
    }
}

// Contacts that neither open nor slide have r = -W^-1 (H^T v_free + b), a direct solve. Friction
// and closing speed are so large that no contact opens or slides, which the reference confirms.
TEST(Nlgs, MatchesADirectSolveWhereAllContactsStick) {
    std::vector<PlanarTensor> inertia;
    ContactProblem problem = wet_chain(6, inertia);
    for (Contact& contact : problem.contacts)
        contact.friction = 50.0, contact.bias = in_plane(-20.0, 0.0);
    Eigen::VectorXd b(12);
    for (int k = 0; k < 6; ++k) {
        const ContactVector u = contact_velocity(problem.contacts[k], problem.free);
        b(2 * k) = u.n + problem.contacts[k].bias.n, b(2 * k + 1) = u.t;
    }
    const Eigen::VectorXd reference = -dense_delassus(problem).ldlt().solve(b);
    for (int k = 0; k < 6; ++k) {
        ASSERT_GT(reference(2 * k), 0.0);
        ASSERT_LT(std::abs(reference(2 * k + 1)), 50.0 * reference(2 * k));
    }
    SolverSettings settings;
    settings.tolerance = 1e-13;
    settings.max_iterations = 100000;
    const SolverResult result = make_solver("nlgs")->solve(problem, Impulses(6), settings);
    ASSERT_TRUE(result.converged);
    for (int k = 0; k < 6; ++k)
        for (int d = 0; d < 2; ++d)
            EXPECT_NEAR(component(result.impulses[k], d), reference(2 * k + d),
                        1e-10 * reference.norm());
}

// With slip and separation: admissible by the published residual, and A (U - U^F) = J for every
// body.
TEST(Nlgs, BalancesMomentumWithAnyInertia) {
    std::vector<PlanarTensor> inertia;
    const ContactProblem problem = wet_chain(8, inertia);
    SolverSettings settings;
    settings.tolerance = 1e-10;
    settings.max_iterations = 100000;
    for (const std::int64_t most : {std::int64_t{3}, std::int64_t{100000}}) {
        settings.max_iterations = most;  // three sweeps do not converge, but still balance
        const SolverResult result = make_solver("nlgs")->solve(problem, Impulses(8), settings);
        EXPECT_EQ(result.converged, most > 3);
        EXPECT_EQ(natural_map_residual(problem, result.impulses), result.residual);
        std::vector<Eigen::Vector3d> received(8, Eigen::Vector3d::Zero());
        for (std::size_t k = 0; k < 8; ++k) {
            const Contact& c = problem.contacts[k];
            const Vec3 p = world_impulse(c, result.impulses[k]);
            received[c.b] += Eigen::Vector3d(p[0], p[1], cross(c.arm_b, p)[2]);
            if (c.a >= 0) received[c.a] -= Eigen::Vector3d(p[0], p[1], cross(c.arm_a, p)[2]);
        }
        for (std::size_t i = 0; i < 8; ++i) {
            const Twist& now = result.velocities[i];
            const Twist& free = problem.free[i];
            const Eigen::Vector3d change(now.velocity[0] - free.velocity[0],
                                         now.velocity[1] - free.velocity[1],
                                         now.spin[2] - free.spin[2]);
            EXPECT_LT((dense(inertia[i]) * change - received[i]).norm(), 1e-12);
        }
    }
}

/// Discs in a heap, pressed together by a common velocity: arms along n, isotropic mobilities.
ContactProblem disc_chain(int length) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> any(-0.4, 0.4);
    ContactProblem problem;
    for (int i = 0; i < length; ++i) {
        planar::bodies(problem).push_back({1.0 + any(random), 4.0 + any(random)});
        problem.free.push_back({{any(random), -1.0, 0.0}, {0.0, 0.0, any(random)}});
        problem.contacts.push_back(touch(i - 1, i, {0.3, 0.4, 0.0}, {-0.3, -0.4, 0.0}));
    }
    return problem;
}

// One additional body without contacts and with anisotropic mobility makes all contacts use the
// general rows.
TEST(Nlgs, GeneralRowsGiveTheAnswerOfTheFastOnes) {
    const ContactProblem fast = disc_chain(10);
    ContactProblem general = fast;
    PlanarTensor spectator(1.0, 1.0);
    spectator.xy = 0.5;
    planar::bodies(general).push_back(spectator);
    general.free.push_back({});
    ASSERT_TRUE(Delassus(fast).diagonal());
    ASSERT_FALSE(Delassus(general).diagonal());
    SolverSettings settings;
    settings.tolerance = 1e-13;
    settings.max_iterations = 100000;
    const SolverResult a = make_solver("nlgs")->solve(fast, Impulses(10), settings);
    const SolverResult b = make_solver("nlgs")->solve(general, Impulses(10), settings);
    ASSERT_TRUE(a.converged && b.converged);
    EXPECT_EQ(a.iterations, b.iterations);
    for (std::size_t k = 0; k < 10; ++k)
        for (int d = 0; d < 2; ++d)
            EXPECT_NEAR(component(a.impulses[k], d), component(b.impulses[k], d), 1e-12);
}

// Column by column: the diagonal block of contact k is the effect of a unit impulse at k on the
// velocity at k.
TEST(Delassus, BlocksAgreeWithTheOperator) {
    const ContactProblem problem = skew_chain(5);
    const Delassus w(problem);
    EXPECT_FALSE(w.diagonal());
    for (std::size_t k = 0; k < 5; ++k) {
        Impulses unit(5);
        unit[k] = in_plane(1.0, 0.0);
        const ContactVector un = w.apply(unit)[k];
        unit[k] = in_plane(0.0, 1.0);
        const ContactVector ut = w.apply(unit)[k];
        EXPECT_NEAR(un.n, w.block(k).nn, 1e-14);
        EXPECT_NEAR(un.t, w.block(k).nt, 1e-14);
        EXPECT_NEAR(ut.n, w.block(k).nt, 1e-14);
        EXPECT_NEAR(ut.t, w.block(k).tt, 1e-14);
    }
}

// W is symmetric: x.W y = y.W x.
TEST(Delassus, IsSymmetric) {
    std::vector<PlanarTensor> inertia;
    const ContactProblem problem = wet_chain(6, inertia);
    const Delassus w(problem);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    Impulses x(6), y(6);
    for (std::size_t k = 0; k < 6; ++k)
        x[k] = in_plane(any(random), any(random)), y[k] = in_plane(any(random), any(random));
    const Impulses wx = w.apply(x), wy = w.apply(y);
    double xwy = 0.0, ywx = 0.0;
    for (std::size_t k = 0; k < 6; ++k) xwy += dot(x[k], wy[k]), ywx += dot(y[k], wx[k]);
    EXPECT_NEAR(xwy, ywx, 1e-13);
}

// The solver's code path for W_nt != 0, tested by the residual alone.
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

// Two sweeps are not enough for eight contacts in a row: the result must report this, with a
// residual above the tolerance.
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
    const ContactProblem problem{
        std::vector<PlanarTensor>{{1.0, 1.0}}, {{-1.0 * contact.normal, {}}}, {contact}};
    EXPECT_NEAR(natural_map_residual(problem, {in_plane(1.0, 0.0)}), 0.0, 1e-15);
    EXPECT_NEAR(natural_map_residual(problem, {in_plane(0.9, 0.0)}), 0.1 / 0.9, 1e-14);
}

// The same at r_n = 0.9: one update makes it 1, du = 0.1, R = 0.95, so quad = max = 0.1/0.95.
TEST(Residual, ChangeMeasuresLookAtOneUpdate) {
    Contact contact = touch(-1, 0, {}, {});
    const ContactProblem problem{
        std::vector<PlanarTensor>{{1.0, 1.0}}, {{-1.0 * contact.normal, {}}}, {contact}};
    const ChangeMeasures change = change_measures(problem, {in_plane(0.9, 0.0)});
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
