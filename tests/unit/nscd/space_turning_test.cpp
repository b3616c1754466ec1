// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Resistance to rolling and torsion of spheres: moments as vectors, limited by the normal impulse.
#include <gtest/gtest.h>

#include "granular_adapter/nscd/problem/residual.hpp"
#include "granular_adapter/nscd/problem/space/sphere_operator.hpp"
#include "granular_adapter/nscd/solvers/nlgs.hpp"
#include "round_walls.hpp"

namespace turbidite::nscd {
namespace {

constexpr double dt = 0.01, radius = 0.5;

EngineSettings resisting(double friction, double rolling, double torsion,
                         double tolerance = 1e-10) {
    EngineSettings settings = scenes::exact_in_space(friction, tolerance);
    Surface surface;
    surface.friction = friction;
    surface.rolling_friction = rolling;
    surface.torsion_friction = torsion;
    settings.surfaces = {surface};
    return settings;
}

Wall rough_floor() {
    Wall wall = scenes::floor(0.0);
    wall.material = 0;
    return wall;
}

/// Velocity and spin at t = 1 of a sphere from rest on a plane of this slope and direction.
Twist down(double slope, double heading, double mu_r) {
    EngineSettings settings = resisting(1.0, mu_r, 0.0);
    const double alpha = std::atan(slope);
    settings.gravity = {std::sin(alpha) * std::cos(heading), -std::cos(alpha),
                        std::sin(alpha) * std::sin(heading)};
    Engine engine(settings, scenes::spheres, {rough_floor()});
    engine.bodies().add(scenes::sphere(1, {0.0, radius, 0.0}));
    EXPECT_TRUE(scenes::run(engine, 1.0, dt));
    return engine.bodies().twist[0];
}

// At rest iff tan a <= mu_r; beyond, a = 5/7 g (sin a - mu_r cos a). In any direction.
TEST(SpaceTurning, ASphereRollsDownIffTheSlopeIsAboveTheCoefficient) {
    for (const double heading : {0.0, 0.6, 2.3, -1.2}) {
        const Vec3 along{std::cos(heading), 0.0, std::sin(heading)};
        const Twist rest = down(0.0999, heading, 0.1);
        EXPECT_LT(norm(rest.velocity), 1e-9);
        EXPECT_LT(norm(rest.spin), 1e-9);
        for (const double slope : {0.101, 0.3}) {
            const double alpha = std::atan(slope);
            const double speed = 5.0 / 7.0 * (std::sin(alpha) - 0.1 * std::cos(alpha));
            const Twist end = down(slope, heading, 0.1);
            EXPECT_NEAR(dot(end.velocity, along), speed, 1e-8);
            EXPECT_NEAR(norm(end.velocity), speed, 1e-8) << "straight";
            EXPECT_NEAR(norm(end.spin), speed / radius, 1e-8);
        }
    }
}

// A spinning sphere: I dw/dt = -mu_t R m g, so it slows down at 5/2 mu_t g/R and stops for good.
TEST(SpaceTurning, TorsionStopsASpinningSphere) {
    Engine engine(resisting(0.3, 0.0, 0.05), scenes::spheres, {rough_floor()});
    engine.bodies().add(scenes::sphere(1, {0.0, radius, 0.0}));
    engine.bodies().twist[0].spin = {0.0, 1.0, 0.0};
    const double rate = 2.5 * 0.05 / radius;
    for (int n = 1; n <= 600; ++n) {
        engine.step(dt);
        engine.move(dt);
        ASSERT_NEAR(engine.bodies().twist[0].spin[1], std::max(0.0, 1.0 - rate * dt * n), 1e-10);
    }
    EXPECT_LT(norm(engine.bodies().twist[0].velocity), 1e-12);
    Engine free(resisting(0.3, 0.1, 0.0), scenes::spheres, {rough_floor()});
    free.bodies().add(scenes::sphere(1, {0.0, radius, 0.0}));
    free.bodies().twist[0].spin = {0.0, 1.0, 0.0};
    EXPECT_TRUE(scenes::run(free, 1.0, dt));
    EXPECT_NEAR(free.bodies().twist[0].spin[1], 1.0, 1e-12) << "resistance to rolling alone";
}

SolverResult solved(const ContactProblem& problem, std::int64_t sweeps, double tolerance) {
    SolverSettings settings;
    settings.max_iterations = sweeps;
    settings.tolerance = tolerance;
    return Nlgs().solve(problem, Impulses(problem.contacts.size()), settings);
}

// A turntable spins a sphere on its axis up at 5/2 mu_t g/R, until it turns along.
TEST(SpaceTurning, ATurntableSpinsASphereUp) {
    Wall table = rough_floor();
    table.twist.spin = {0.0, 1.0, 0.0};
    Engine engine(resisting(0.3, 0.0, 0.05), scenes::spheres, {table});
    engine.bodies().add(scenes::sphere(1, {0.0, radius, 0.0}));
    const double rate = 2.5 * 0.05 / radius;
    for (int n = 1; n <= 600; ++n) {
        engine.step(dt);
        engine.move(dt);
        ASSERT_NEAR(engine.bodies().twist[0].spin[1], std::min(1.0, rate * dt * n), 1e-10);
    }
    // The kernel for films finds the same.
    ContactProblem problem = engine.problem();
    problem.films.assign(problem.contacts.size(), Film{});
    problem.free[0].spin[1] = 0.0;
    const SolverResult found = solved(problem, 100, 1e-12);
    ASSERT_EQ(found.impulses.moments.size(), 1u);
    EXPECT_NEAR(found.impulses.moments[0][1], 0.05 * radius * found.impulses[0].n, 1e-12);
}

// Without weight, in a drum that turns: nothing rolls or twists, so that no moment acts.
TEST(SpaceTurning, NothingIsResistedWhereAllTurnsTogether) {
    EngineSettings settings = resisting(0.5, 0.2, 0.2);
    settings.gravity = {};
    Wall drum = scenes::tube(5.0, 4.0);
    drum.material = 0;
    drum.twist.spin = {0.0, 0.0, 1.0};
    Engine engine(settings, scenes::spheres, {drum});
    Body sphere = scenes::sphere(1, {0.0, -4.5, 0.0});
    sphere.twist = {{4.5, 0.0, 0.0}, {0.0, 0.0, 1.0}};
    engine.bodies().add(sphere);
    int touching = 0;
    for (int n = 0; n < 1000; ++n) {
        touching += engine.step(0.002).contacts > 0;
        engine.move(0.002);
        ASSERT_NEAR(engine.bodies().twist[0].spin[2], 1.0, 1e-2);
    }
    EXPECT_GT(touching, 900);
}

/// A single contact between bodies with r_a/I_a over r_b/I_b of `ratio`, with random velocities.
ContactProblem pair_of(double ratio, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    ContactProblem problem;
    problem.bodies = std::vector<SpaceMobility>{{1.3, 4.0 * ratio}, {0.8, 4.0}};
    for (int i = 0; i < 2; ++i)
        problem.free.push_back(
            {{any(random), any(random), any(random)}, {any(random), any(random), any(random)}});
    Contact c;
    c.a = 0, c.b = 1;
    const Vec3 x{any(random), any(random), any(random)};
    c.normal = (1.0 / norm(x)) * x;
    c.tangent = tangent_of(c.normal);
    c.arm_a = 0.5 * c.normal, c.arm_b = -0.5 * c.normal;
    c.friction = 0.3 * (1.0 + any(random));
    c.rolling = 0.1 * (1.0 + any(random)), c.torsion = 0.1 * (1.0 + any(random));
    c.bias.n = -2.0;
    problem.contacts = {c};
    return problem;
}

// In every combination of limits reached and not: without coupling of moments and friction one
// update is exact, otherwise updates converge.
TEST(SpaceTurning, AContactIsSolvedExactlyWithoutCouplingAndByIterationWithIt) {
    std::array<int, 8> limits{};
    for (unsigned seed = 0; seed < 3000; ++seed) {
        const ContactProblem problem = pair_of(1.0, seed);
        const SolverResult once = solved(problem, 1, 1e-12);
        ASSERT_LE(once.residual, 1e-12) << seed;
        const Contact& c = problem.contacts[0];
        const ContactVector& r = once.impulses[0];
        ASSERT_EQ(once.impulses.moments.size(), 1u);
        const Vec3 moment = once.impulses.moments[0];
        const Vec3 along = dot(c.normal, moment) * c.normal;
        const double most = r.n * (1.0 + 1e-12);
        ASSERT_LE(tangential(r), c.friction * most);
        ASSERT_LE(norm(along), c.torsion * most);
        ASSERT_LE(norm(moment - along), c.rolling * most);
        const auto at = [&](double x, double slope) {
            return x > slope * r.n * (1 - 1e-9) ? 1 : 0;
        };
        ++limits[static_cast<std::size_t>(at(tangential(r), c.friction) +
                                          2 * at(norm(along), c.torsion) +
                                          4 * at(norm(moment - along), c.rolling))];
        const ContactProblem coupled = pair_of(0.2, seed);
        ASSERT_LE(solved(coupled, 500, 1e-12).residual, 1e-12) << seed;
    }
    for (const int count : limits) EXPECT_GT(count, 10);
    EXPECT_GT(solved(pair_of(0.2, 1), 1, 1e-12).residual, 1e-6) << "the residual knows of the rest";
}

// The projection of turning_contact.hpp is the closest point of the cone: none of it is closer.
TEST(SpaceTurning, TheProjectionIsTheClosestPoint) {
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    for (int i = 0; i < 3000; ++i) {
        const std::array<double, 3> size{any(random), any(random), any(random)};
        const std::array<double, 3> slope{2 * any(random), any(random), any(random)};
        const double x = 3.0 * any(random) - 2.0;
        const auto distance = [&](double n) {
            double sum = (n - x) * (n - x);
            for (std::size_t k = 0; k < 3; ++k)
                sum += std::pow(std::max(0.0, size[k] - slope[k] * n), 2);
            return sum;
        };
        const double n = nearest_normal(x, size, slope);
        for (const double other : {0.0, 0.9 * n, n - 1e-4, n + 1e-4, 1.1 * n, n + 0.5})
            if (other >= 0.0) {
                ASSERT_GE(distance(other), distance(n) - 1e-15) << i;
            }
    }
}

/// Momentum and angular momentum about the origin.
std::pair<Vec3, Vec3> momentum(const Bodies& b) {
    std::pair<Vec3, Vec3> sum{};
    for (std::size_t i = 0; i < b.size(); ++i) {
        const Vec3 p = b.mass[i] * b.twist[i].velocity;
        sum.first = sum.first + p;
        sum.second = sum.second + cross(b.position[i], p) + b.inertia[i] * b.twist[i].spin;
    }
    return sum;
}

// Moments act on both bodies; at walls they are reported with their impulse.
TEST(SpaceTurning, MomentsBalanceToRoundOff) {
    EngineSettings settings = resisting(0.5, 0.1, 0.05, 1e-3);
    settings.solver_settings.max_iterations = 20;
    Engine engine = scenes::settling_spheres(5, 5, settings);
    for (Wall& wall : engine.walls()) wall.material = 0;
    scenes::run(engine, 1.0, dt);
    const Bodies& b = engine.bodies();
    const std::vector<Twist> before = b.twist;
    auto expected = momentum(b);
    engine.step(dt);
    double largest = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i) {
        const Vec3 weight{0.0, -b.weight_mass[i] * dt, 0.0};
        expected.first = expected.first + weight;
        expected.second = expected.second + cross(b.position[i], weight);
        const Vec3 turn = b.inertia[i].xx * (b.twist[i].spin - before[i].spin);
        EXPECT_LT(norm(turn - b.contact_angular_impulse[i]), 1e-13);
    }
    ASSERT_EQ(engine.impulses().moments.size(), engine.points().size());
    for (std::size_t k = 0; k < engine.points().size(); ++k) {
        const Vec3 moment = world_moment(engine.impulses(), k);
        largest = std::max(largest, norm(moment));
        const ContactPoint& point = engine.points()[k];
        if (point.wall < 0) continue;
        const Vec3 p = world_impulse(engine.problem().contacts[k], engine.impulses()[k]);
        expected.first = expected.first + p;
        expected.second = expected.second + cross(b.position[point.b] + point.arm_b, p) + moment;
    }
    EXPECT_GT(largest, 1e-5);
    const auto now = momentum(b);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(now.first[axis], expected.first[axis], 1e-12);
        EXPECT_NEAR(now.second[axis], expected.second[axis], 1e-12);
    }
}

// With resistance to rolling a packing comes to rest to the last sphere, and its moments are
// remembered: the next steps converge at the first looks, and after a restart they have the same
// bits.
TEST(SpaceTurning, APackingComesToRestAndIsRestored) {
    EngineSettings settings = resisting(0.5, 0.1, 0.1, 1e-4);
    settings.solver_settings.max_iterations = 5000;
    const auto make = [&] {
        Engine engine = scenes::settling_spheres(5, 5, settings);
        for (Wall& wall : engine.walls()) wall.material = 0;
        // Without a push the columns of the lattice stand for long.
        std::mt19937_64 random(3);
        std::uniform_real_distribution<double> any(-1.0, 1.0);
        for (Twist& twist : engine.bodies().twist)
            twist.velocity = {any(random), any(random), any(random)};
        return engine;
    };
    Engine engine = make();
    scenes::run(engine, 18.0, dt);
    EXPECT_LT(scenes::kinetic_energy(engine.bodies()), 1e-5);
    const StepReport report = engine.step(dt);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.iterations, 64);
    ASSERT_FALSE(engine.guess().moments.empty());
    double difference = 0.0, size = 0.0;
    for (std::size_t k = 0; k < engine.points().size(); ++k) {
        difference += norm(engine.guess().moments[k] - engine.solution().moments[k]);
        size += norm(engine.solution().moments[k]);
    }
    EXPECT_GT(size, 1e-6);
    EXPECT_LT(difference, 0.1 * size);
    engine.move(dt);
    Engine other = make();
    other.restore(engine.save());
    EXPECT_EQ(other.save(), engine.save());
    scenes::run(engine, 0.3, dt);
    scenes::run(other, 0.3, dt);
    EXPECT_EQ(other.save(), engine.save());
}

}  // namespace
}  // namespace turbidite::nscd
