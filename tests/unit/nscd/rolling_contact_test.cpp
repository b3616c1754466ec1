// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/plane/rolling_contact.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/problem/plane/delassus.hpp"
#include "granular_adapter/nscd/problem/residual.hpp"
#include "granular_adapter/nscd/solvers/nlgs.hpp"
#include "planar.hpp"
#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

ContactVector velocity(const Block& w, const ContactVector& b, const ContactVector& r) {
    return in_plane(b.n + w.nn * r.n + w.nt * r.t + w.nr * r.roll,
                    b.t + w.nt * r.n + w.tt * r.t + w.tr * r.roll,
                    b.roll + w.nr * r.n + w.tr * r.t + w.rr * r.roll);
}

/// The law itself, term by term, relative to the rounding error of its terms.
void expect_solved(const Block& w, const ContactVector& b, const ContactVector& r, double mu,
                   double rho) {
    const ContactVector u = velocity(w, b, r);
    const double scale = std::sqrt(dot(b, b)) + 1e-300,
                 size = std::max(std::sqrt(dot(r, r)), 1e-300);
    const double eps = 1e-10 * scale;
    EXPECT_GE(r.n, 0.0);
    EXPECT_GE(u.n, -eps);
    EXPECT_LE(std::abs(u.n * r.n), eps * size);
    EXPECT_LE(std::abs(r.t), mu * r.n * (1.0 + 1e-15));
    EXPECT_LE(std::abs(r.roll), rho * r.n * (1.0 + 1e-15));
    EXPECT_NEAR(r.t * u.t, -mu * r.n * std::abs(u.t), eps * size) << "friction opposes slip";
    EXPECT_NEAR(r.roll * u.roll, -rho * r.n * std::abs(u.roll), eps * size) << "rolling alike";
}

class RollingContact : public ::testing::Test {
 protected:
    double any() { return uniform_(random_); }

    /// Positive definite; for discs, n is uncoupled.
    Block random_block(bool disc) {
        Eigen::Matrix3d a;
        for (int i = 0; i < 9; ++i) a(i) = any();
        const Eigen::Matrix3d s = a * a.transpose() + 0.02 * Eigen::Matrix3d::Identity();
        if (disc) return {s(0, 0), 0.0, s(1, 1), 0.0, s(1, 2), s(2, 2)};
        return {s(0, 0), s(0, 1), s(1, 1), s(0, 2), s(1, 2), s(2, 2)};
    }

    std::mt19937_64 random_{5};
    std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

TEST_F(RollingContact, DiscsAreSolvedExactly) {
    for (int i = 0; i < 100000; ++i) {
        const Block w = random_block(true);
        const ContactVector b = in_plane(any() - 0.5, any(), any());
        const double mu = 1.0 + any(), rho = 0.5 * (1.0 + any());
        expect_solved(w, b, solve_rolling_contact(w, b, mu, rho), mu, rho);
        if (HasFailure()) FAIL() << "case " << i;
    }
}

TEST_F(RollingContact, AnyWIsSolvedExactly) {
    for (int i = 0; i < 100000; ++i) {
        const Block w = random_block(false);
        const ContactVector b = in_plane(any() - 0.5, any(), any());
        const double mu = 1.0 + any(), rho = 0.5 * (1.0 + any());
        expect_solved(w, b, solve_rolling_contact(w, b, mu, rho), mu, rho);
        if (HasFailure()) FAIL() << "case " << i;
    }
}

// Without friction or without rolling resistance: equals the other function.
TEST_F(RollingContact, IsCoulombWithoutResistance) {
    for (int i = 0; i < 1000; ++i) {
        const Block w = random_block(i % 2 == 0);
        const ContactVector b = in_plane(any() - 0.5, any(), any());
        const double mu = 1.0 + any();
        const Plane plane = solve_contact(w, {b.n, b.t}, mu);
        const ContactVector r = solve_rolling_contact(w, b, mu, 0.0);
        // With strong coupling two solutions may exist; then this one must satisfy the law equally
        // well.
        if (std::abs(r.n - plane[0]) > 1e-9 * (1.0 + plane[0]))
            expect_solved({w.nn, w.nt, w.tt}, in_plane(b.n, b.t), in_plane(r.n, r.t), mu, 0.0);
        EXPECT_EQ(r.roll, 0.0);
    }
}

// The projection is the closest point: no other point of the pyramid is closer.
TEST_F(RollingContact, ProjectionIsTheNearestPoint) {
    for (int i = 0; i < 20000; ++i) {
        const ContactVector x = in_plane(2.0 * any(), 2.0 * any(), 2.0 * any());
        const double mu = 1.0 + any(), rho = 1.0 + any();
        const ContactVector p = project_on_pyramid(x, mu, rho);
        EXPECT_LE(std::abs(p.t), mu * p.n * (1 + 1e-15) + 1e-300);
        EXPECT_LE(std::abs(p.roll), rho * p.n * (1 + 1e-15) + 1e-300);
        // Moreau's decomposition: x - p is orthogonal to p and in the polar cone.
        const ContactVector q = x - p;
        EXPECT_NEAR(dot(p, q), 0.0, 1e-12);
        EXPECT_LE(q.n + mu * std::abs(q.t) + rho * std::abs(q.roll), 1e-12);
    }
}

// A disc on an incline with enough friction rolls iff tan(alpha) > rho/R.
TEST(RollingResistance, HoldsADiscOnASlopeBelowItsAngle) {
    for (const double tangent : {0.09, 0.11}) {
        const double lever = 0.05;  // R = 1/2: limit 0.1
        ContactProblem problem;
        const Body body = scenes::disc(1, 0.0, 0.5);
        problem.bodies = std::vector<PlanarTensor>{{1.0 / body.mass, 1.0 / body.inertia.zz}};
        const Vec3 g = scenes::tilted(std::atan(tangent));
        problem.free = {{0.01 * g, {}}};
        Contact contact;
        contact.b = 0;
        contact.normal = {0, 1, 0};
        contact.tangent = tangent_of(contact.normal);
        contact.arm_b = {0, -0.5, 0};
        contact.friction = 0.5;
        contact.rolling = lever;
        problem.contacts = {contact};
        SolverSettings settings;
        settings.tolerance = 1e-12;
        const SolverResult result = Nlgs().solve(problem, Impulses(1), settings);
        ASSERT_TRUE(result.converged);
        const double speed = result.velocities[0].velocity[0];
        if (tangent < 0.1) {
            EXPECT_NEAR(speed, 0.0, 1e-15);
            EXPECT_NEAR(result.impulses[0].roll, 0.5 * body.mass * 0.01 * g[0], 1e-12)
                << "the moment that weight has about the contact";
        } else {
            // (m + I/R2) a = m g sin - rho m g cos / R
            const double rolls = 0.01 * (g[0] + lever / 0.5 * g[1]) / 1.5;
            EXPECT_NEAR(speed, rolls, 1e-14);
            EXPECT_NEAR(result.velocities[0].spin[2], -rolls / 0.5, 1e-13);
        }
        EXPECT_LE(natural_map_residual(problem, result.impulses), 1e-12);
        EXPECT_LE(change_measures(problem, result.impulses).max, 1e-10);
    }
}

TEST(RollingResistance, DelassusHasTheRowOfMoments) {
    ContactProblem problem;
    problem.bodies = std::vector<PlanarTensor>{{0.5, 1.0}, {0.25, 0.125}};
    problem.free.resize(2);
    Contact contact;
    contact.a = 0, contact.b = 1;
    contact.normal = {0.6, 0.8, 0.0};
    contact.tangent = tangent_of(contact.normal);
    contact.arm_a = {0.3, 0.4, 0.0};
    contact.arm_b = {-0.5, -0.1, 0.0};
    contact.rolling = 0.1;
    problem.contacts = {contact};
    const Delassus w(problem);
    for (int d = 0; d < 3; ++d) {
        Impulses unit(1);
        planar::component(unit[0], d) = 1.0;
        const ContactVector u = w.apply(unit)[0];
        const Block& block = w.block(0);
        const double row[3][3] = {{block.nn, block.nt, block.nr},
                                  {block.nt, block.tt, block.tr},
                                  {block.nr, block.tr, block.rr}};
        for (int e = 0; e < 3; ++e) EXPECT_NEAR(planar::component(u, e), row[e][d], 1e-15);
    }
    EXPECT_TRUE(w.rolling());
}

}  // namespace
}  // namespace turbidite::nscd
