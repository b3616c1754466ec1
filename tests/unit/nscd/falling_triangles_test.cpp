// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/problem/residual.hpp"
#include "polygons.hpp"

namespace turbidite::nscd {
namespace {

constexpr double dt = 0.005, friction = 0.3, width = 7.0, height = 20.0;
constexpr int count = 30;

Engine falling_triangles(double tolerance = 1e-4) {
    EngineSettings settings = scenes::exact(friction, tolerance);
    settings.solver_settings.max_iterations = 5000;
    return scenes::falling_triangles(count, width, height, settings);
}

double mean_speed(const Bodies& bodies) {
    double sum = 0.0;
    for (const Twist& twist : bodies.twist) sum += norm(twist.velocity);
    return sum / static_cast<double>(bodies.size());
}

/// The largest overlap during a time.
double play(Engine& engine, double time) {
    double deepest = 0.0;
    for (int n = 0; n < std::lround(time / dt); ++n) {
        engine.step(dt);
        engine.move(dt);
        deepest = std::max(deepest, engine.max_penetration());
    }
    return deepest;
}

double largest_speed(const Bodies& bodies) {
    double largest = 0.0;
    for (const Twist& twist : bodies.twist) largest = std::max(largest, norm(twist.velocity));
    return largest;
}

double largest_displacement(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
    double largest = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i)
        largest = std::max(largest, norm(to[i] - from[i]));
    return largest;
}

// They fall, tumble and come to rest without overlap. Then nothing moves: no grain loses a fifth of
// its support in any step, and none creeps. Which contacts carry the load is not tested: the
// packing is hyperstatic, and loads shift between states that are all in equilibrium.
TEST(FallingTriangles, ComeToRestWithoutOverlapOrJitter) {
    Engine engine = falling_triangles();
    EXPECT_LT(play(engine, 20.0), 1e-4);
    const std::vector<Vec3> start = engine.bodies().position;
    for (int n = 0; n < 200; ++n) {
        EXPECT_LT(play(engine, dt), 1e-5);
        ASSERT_LT(mean_speed(engine.bodies()), 1e-4);
        ASSERT_LT(largest_speed(engine.bodies()), 0.2 * dt);
    }
    EXPECT_LT(largest_displacement(start, engine.bodies().position), 2e-5);
    double lowest = height;
    for (const Vec3& x : engine.bodies().position) lowest = std::min(lowest, x[1]);
    EXPECT_GE(lowest, 0.375 - 1e-5);  // height of a triangle that lies on its side
}

// Two runs are equal bit for bit.
TEST(FallingTriangles, AreDeterministic) {
    Engine one = falling_triangles(), two = falling_triangles();
    play(one, 4.0), play(two, 4.0);
    EXPECT_EQ(one.save(), two.save());
}

// What tells of a step afterwards is of the problem that was solved, also where corners that turned
// had it solved again.
TEST(FallingTriangles, LeaveTheProblemThatWasSolved) {
    Engine engine = falling_triangles(1e-9);
    double violation = 0.0;
    std::int64_t contacts = 0;
    for (int n = 0; n < 800; ++n) {
        const StepReport report = engine.step(dt);
        EXPECT_NEAR(natural_map_residual(engine.problem(), engine.solution()), report.residual,
                    1e-9 + 1e-6 * report.residual)
            << n;
        if (report.converged) violation = std::max(violation, engine.contact_violation());
        contacts += report.contacts;
        engine.move(dt);
    }
    EXPECT_GT(contacts, 1000);
    EXPECT_LT(violation, 1e-7);
}

}  // namespace
}  // namespace turbidite::nscd
