// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Rolling resistance as a law: the lever it passes to the solver, and a disc (R = 1/2, g = 1) on a
// tilted plane.
#include <gtest/gtest.h>

#include <numbers>

#include "granular_adapter/nscd/problem/residual.hpp"
#include "granular_adapter/nscd/solvers/nlgs.hpp"
#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

constexpr double mu = 0.5, rolling = 0.1;

EngineSettings resisting() {
    EngineSettings settings = scenes::exact(mu, 1e-13);
    Surface surface;
    surface.friction = mu;
    surface.rolling_friction = rolling;
    settings.surfaces = {surface};
    return settings;
}

// mu_r times the reduced radius: R at a wall, R/2 between equal discs.
TEST(RollingResistance, LeverGoesWithTheReducedRadius) {
    Engine engine(resisting(), scenes::discs, {scenes::floor(mu)});
    engine.bodies().add(scenes::disc(1, 0.0, 0.5));
    engine.bodies().add(scenes::disc(2, 0.0, 1.5));
    engine.step(0.01);
    ASSERT_EQ(engine.points().size(), 2u);
    for (std::size_t k = 0; k < 2; ++k)
        EXPECT_NEAR(engine.problem().contacts[k].rolling,
                    engine.points()[k].wall >= 0 ? 0.05 : 0.025, 1e-16);
}

TEST(RollingResistance, IsRefusedForShapesWithCorners) {
    EngineSettings settings = resisting();
    const SurfaceTable surfaces(settings.surfaces);
    const ShapeTable triangles = {{"triangle", {1, 0, -0.5, 0.75, -0.5, -0.75}}};
    EXPECT_THROW(ContactLaws({}, {}, surfaces, triangles), std::invalid_argument);
    settings.surfaces[0].rolling_friction = 0.0;
    EXPECT_NO_THROW(ContactLaws({}, {}, SurfaceTable(settings.surfaces), triangles));
}

/// Velocity and spin after t = 1 on a slope, from rest.
Twist on_slope(double slope) {
    EngineSettings settings = resisting();
    settings.gravity = scenes::tilted(std::atan(slope));
    Engine engine(settings, scenes::discs, {scenes::floor(mu)});
    engine.bodies().add(scenes::disc(1, 0.0, 0.5));
    EXPECT_TRUE(scenes::run(engine, 1.0, 0.01));
    return engine.bodies().twist[0];
}

TEST(RollingResistance, HoldsADiscUpToItsSlope) {
    for (const double share : {0.5, 0.999}) {
        const Twist end = on_slope(share * rolling);
        EXPECT_NEAR(end.velocity[0], 0.0, 1e-12);
        EXPECT_NEAR(end.spin[2], 0.0, 1e-12);
    }
}

// Rolls: I a/R = F R - mu_r R N and m a = m g sin - F give a = 2/3 g (sin - mu_r cos), as long as
// F = m g (sin + 2 mu_r cos)/3 <= mu N: tan <= 3 mu - 2 mu_r.
TEST(RollingResistance, RollsBeyondIt) {
    for (const double slope : {1.001 * rolling, 1.0, 0.999 * (3 * mu - 2 * rolling)}) {
        const double alpha = std::atan(slope);
        const Twist end = on_slope(slope);
        EXPECT_NEAR(end.velocity[0], 2.0 / 3.0 * (std::sin(alpha) - rolling * std::cos(alpha)),
                    1e-11);
        EXPECT_NEAR(end.spin[2], -2.0 * end.velocity[0], 1e-10);
    }
}

// Slides: a = g (sin - mu cos), spin rate -(mu - mu_r) g cos R m/I = -4 (mu - mu_r) cos.
TEST(RollingResistance, SlidesBeyondTheFrictionCone) {
    const double slope = 1.001 * (3 * mu - 2 * rolling), alpha = std::atan(slope);
    const Twist end = on_slope(slope);
    EXPECT_NEAR(end.velocity[0], std::sin(alpha) - mu * std::cos(alpha), 1e-11);
    EXPECT_NEAR(end.spin[2], -4.0 * (mu - rolling) * std::cos(alpha), 1e-10);
}

/// A disc of this spin on a floor that turns at 1 about the contact point: its spin and moment
/// impulse after a step, as found by the sweep over discs and by that over any contacts.
void expect_on_turning_floor(double spin, double after, double moment) {
    Wall turning = scenes::floor(mu);
    turning.twist.spin = {0.0, 0.0, 1.0};
    Engine engine(resisting(), scenes::discs, {turning});
    Body disc = scenes::disc(1, 0.0, 0.5);
    disc.twist = {{-0.5 * spin, 0.0, 0.0}, {0.0, 0.0, spin}};
    engine.bodies().add(disc);
    engine.step(0.01);
    EXPECT_NEAR(engine.bodies().twist[0].spin[2], after, 1e-13);
    ContactProblem problem = engine.problem();
    ASSERT_EQ(problem.contacts.size(), 1u);
    for (const bool any : {false, true}) {
        if (any) problem.films.assign(1, Film{});
        const SolverResult found =
            Nlgs().solve(problem, Impulses(1), {.tolerance = 1e-13, .max_iterations = 100});
        EXPECT_NEAR(found.impulses[0].roll, moment, 1e-13) << any;
        EXPECT_LE(natural_map_residual(problem, found.impulses), 1e-12) << any;
    }
}

// Only the spin relative to the wall is resisted. In a step r_n = m g dt, and the moment's limit is
// mu_r R m g dt: friction keeps the disc rolling, v = -R w, so I + m R^2 = 3/2 m R^2 turns.
TEST(RollingResistance, IsRelativeToAWallThatTurns) {
    const double mass = std::numbers::pi / 4, limit = rolling * 0.5 * mass * 0.01;
    const double change = limit / (1.5 * mass * 0.25);
    expect_on_turning_floor(1.0, 1.0, 0.0);
    expect_on_turning_floor(0.0, change, limit);
    expect_on_turning_floor(2.0, 2.0 - change, -limit);
    // Held by less than the limit where one step is enough.
    expect_on_turning_floor(1.0 - 0.5 * change, 1.0, 0.5 * limit);
}

}  // namespace
}  // namespace turbidite::nscd
