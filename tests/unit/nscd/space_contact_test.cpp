// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One contact of spheres: its solution and the natural map.
#include <gtest/gtest.h>

#include <random>

#include "granular_adapter/nscd/problem/residual.hpp"
#include "granular_adapter/nscd/problem/space/sphere_operator.hpp"
#include "granular_adapter/nscd/solvers/nlgs.hpp"

namespace turbidite::nscd {
namespace {

constexpr int many = 100'000;

class Random {
 public:
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    Vec3 vector(double size) {
        return {between(-size, size), between(-size, size), between(-size, size)};
    }
    Vec3 direction() {
        std::normal_distribution<double> any;
        const Vec3 x{any(engine_), any(engine_), any(engine_)};
        return (1.0 / norm(x)) * x;
    }
    /// Of magnitudes that differ by up to 1e6.
    double scale() { return std::pow(10.0, between(-3.0, 3.0)); }

 private:
    std::mt19937_64 engine_{11};
};

double size(const ContactVector& x) {
    return std::sqrt(x.n * x.n + x.t * x.t + x.s * x.s);
}

// In every regime: open, sticking, sliding.
TEST(SphereContact, SolutionsAreZerosOfTheNaturalMap) {
    Random random;
    int open = 0, sticking = 0, sliding = 0;
    for (int i = 0; i < many; ++i) {
        const double linear = random.scale();
        const SphereBlock w{linear, linear * random.between(1.0, 6.0)};
        const double speed = random.scale(), mu = random.between(0.0, 1.5);
        const ContactVector b =
            speed * ContactVector{random.between(-1, 0.5), random.between(-1, 1),
                                  random.between(-1, 1), 0.0};
        const ContactVector r = solve_contact(w, b, mu);
        const ContactVector u = b + product(w, r);
        const double rho = 1.0 / w.nn;
        ASSERT_LE(size(natural_map(r, u, mu, rho)), 1e-12 * rho * size(b)) << i;
        if (r.n == 0.0)
            ++open;
        else
            ++(tangential(u) > 1e-9 * size(b) ? sliding : sticking);
    }
    EXPECT_GT(open, many / 10);
    EXPECT_GT(sticking, many / 10);
    EXPECT_GT(sliding, many / 10);
}

// The projection is the closest point of the cone: no random point of it is closer.
TEST(SphereContact, TheProjectionIsTheClosestPointOfTheCone) {
    Random random;
    const auto distance = [](const ContactVector& a, const ContactVector& b) {
        return size(a - b);
    };
    for (int i = 0; i < 2000; ++i) {
        const double mu = random.between(0.0, 2.0);
        const ContactVector x{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1),
                              0.0};
        const ContactVector nearest = project_on_cone(x, mu);
        ASSERT_LE(tangential(nearest), mu * nearest.n * (1.0 + 1e-15) + 1e-300);
        for (int k = 0; k < 50; ++k) {
            ContactVector other = nearest;
            other.t += random.between(-0.1, 0.1), other.s += random.between(-0.1, 0.1);
            other.n += random.between(-0.1, 0.1);
            if (tangential(other) > mu * other.n) continue;
            ASSERT_GE(distance(other, x), distance(nearest, x) - 1e-14) << i;
        }
    }
}

// A map that is not zero tells of everything that is wrong.
TEST(SphereContact, WrongImpulsesHaveAResidual) {
    const SphereBlock w{2.0, 7.0};
    const ContactVector b{-1.0, 0.6, -0.8, 0.0};
    const ContactVector r = solve_contact(w, b, 0.3);
    const auto residual = [&](const ContactVector& x) {
        return size(natural_map(x, b + product(w, x), 0.3, 1.0 / w.nn));
    };
    EXPECT_LT(residual(r), 1e-15);
    EXPECT_GT(residual({r.n + 1e-3, r.t, r.s, 0.0}), 1e-4) << "too strong";
    EXPECT_GT(residual({r.n, 0.9 * r.t, 0.9 * r.s, 0.0}), 1e-3) << "friction too weak";
    EXPECT_GT(residual({r.n, r.s, -r.t, 0.0}), 1e-2) << "friction not against the slip";
    EXPECT_GT(residual({r.n, 2.0 * r.t, 2.0 * r.s, 0.0}), 1e-2) << "beyond the cone";
}

/// Pairs of spheres that do not touch other ones, with any velocities and biases.
ContactProblem pairs(int count) {
    Random random;
    ContactProblem problem;
    std::vector<SpaceMobility> bodies;
    for (int k = 0; k < count; ++k) {
        Contact contact;
        for (std::int32_t* body : {&contact.a, &contact.b}) {
            *body = static_cast<std::int32_t>(bodies.size());
            bodies.push_back({random.between(0.1, 10.0), random.between(0.1, 100.0)});
            problem.free.push_back({random.vector(1.0), random.vector(1.0)});
        }
        contact.normal = random.direction();
        contact.tangent = tangent_of(contact.normal);
        contact.arm_a = random.between(0.3, 0.7) * contact.normal;
        contact.arm_b = -random.between(0.3, 0.7) * contact.normal;
        contact.friction = random.between(0.0, 1.0);
        contact.bias = {random.between(-0.5, 0.2), k % 3 == 0 ? random.between(-0.5, 0.5) : 0.0,
                        0.0, 0.0};
        problem.contacts.push_back(contact);
    }
    problem.bodies = std::move(bodies);
    return problem;
}

/// Of the terms whose rounding is left in u: what the bodies have at the contact.
double rounded_speed(const ContactProblem& problem, const std::vector<Twist>& v, const Contact& c) {
    double sum = size(c.bias);
    for (const auto* twists : {&problem.free, &v})
        for (const auto& [body, arm] : {std::pair{c.a, norm(c.arm_a)}, {c.b, norm(c.arm_b)}}) {
            const Twist& twist = (*twists)[static_cast<std::size_t>(body)];
            sum += norm(twist.velocity) + arm * norm(twist.spin);
        }
    return sum;
}

// One sweep is exact where contacts share no body.
TEST(SphereContact, ASweepSolvesSingleContactsExactly) {
    const ContactProblem problem = pairs(many);
    SolverSettings settings;
    settings.tolerance = 1e-12;
    settings.max_iterations = 1;
    const SolverResult result = Nlgs().solve(problem, Impulses(problem.contacts.size()), settings);
    EXPECT_LE(result.residual, 1e-12);
    EXPECT_TRUE(result.converged);
    const SphereOperator w(problem);
    int loaded = 0;
    for (std::size_t k = 0; k < problem.contacts.size(); ++k) {
        const Contact& c = problem.contacts[k];
        const ContactVector u = contact_velocity(c, result.velocities) + c.bias;
        const double rho = 1.0 / w.block(k).nn;
        ASSERT_LE(size(natural_map(result.impulses[k], u, c.friction, rho)),
                  1e-12 * rho * rounded_speed(problem, result.velocities, c));
        if (result.impulses[k].n > 0.0) ++loaded;
    }
    EXPECT_GT(loaded, many / 3);
}

// Broken on purpose: half the bias of a contact is a residual.
TEST(SphereContact, TheResidualOfAProblemSeesASingleWrongContact) {
    const ContactProblem problem = pairs(100);
    SolverSettings settings;
    settings.tolerance = 1e-12;
    Impulses r = Nlgs().solve(problem, Impulses(100), settings).impulses;
    EXPECT_LE(natural_map_residual(problem, r), 1e-12);
    for (ContactVector& x : r)
        if (x.n > 0.0) {
            x.s += 0.1 * x.n;
            break;
        }
    EXPECT_GT(natural_map_residual(problem, r), 1e-6);
}

}  // namespace
}  // namespace turbidite::nscd
