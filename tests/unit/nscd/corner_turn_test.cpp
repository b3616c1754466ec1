// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/corner_turn.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "coupler/rigid/vec3.hpp"
#include "polygons.hpp"

namespace turbidite::nscd {
namespace {

/// After one step of a square that spins at 3 under a grain that slides along its upper side at 2
/// and approaches it.
struct AfterTurn {
    double overlap, approach, departure;  ///< of the surfaces, along the normal
};
AfterTurn after_turn(double dt, bool disc, double restitution) {
    const ShapeTable shapes = {scenes::square_record(), {"triangle", {}}, {"disc", {}}};
    EngineSettings settings = scenes::exact(0.0, 1e-12);
    settings.gravity = {};
    Surface smooth;
    smooth.restitution = restitution;
    settings.surfaces = {smooth};
    Engine engine(settings, shapes, {});
    Body driven = scenes::unit_square(shapes, 1, 0.0, 0.0);
    driven.fixed = true;
    driven.twist.spin = {0.0, 0.0, 3.0};
    engine.bodies().add(driven);
    // At half a turn the triangle stands on its corner.
    Body grain = disc ? scenes::disc(2, 0.1, 1.0)
                      : scenes::polygon(shapes, 1, 2, 0.1, 1.0, 0.5, std::numbers::pi);
    if (disc) grain.shape = 2;
    grain.twist.velocity = {2.0, -1.0, 0.0};
    engine.bodies().add(grain);
    const std::vector<Twist> before = std::as_const(engine).bodies().twist;
    engine.step(dt);
    const Contact contact = engine.problem().contacts.at(0);
    const double approach = -contact_velocity(contact, before).n;
    const double departure = contact_velocity(contact, engine.bodies().twist).n;
    engine.move(dt);
    return {engine.max_penetration(), approach, departure};
}

double overlap_after(double dt, bool disc) {
    return after_turn(dt, disc, 0.0).overlap;
}

// The side rotates towards the grain's motion: without the correction the overlap would be of
// second order, about dt^2 w v_t = 6 dt^2.
TEST(CornerTurn, OverlapIsOfThirdOrder) {
    for (const bool disc : {false, true})
        for (const double dt : {0.02, 0.01, 0.005})
            EXPECT_LT(overlap_after(dt, disc), 12.0 * dt * dt * dt) << dt;
}

// Where the rebound takes the grain farther than the side turns nothing is to be made up for.
TEST(CornerTurn, AddsNothingToARebound) {
    for (const bool disc : {false, true})
        for (const double dt : {0.02, 0.01}) {
            const AfterTurn whole = after_turn(dt, disc, 1.0);
            EXPECT_GT(whole.approach, 0.5);
            EXPECT_NEAR(whole.departure, whole.approach, 1e-12) << dt;
            // A weak rebound, e u^- dt < the shortfall: what is left of it counts.
            EXPECT_LT(after_turn(dt, disc, 0.01).overlap, 12.0 * dt * dt * dt) << dt;
        }
}

// Without rotation the predicted gap is exact, to rounding.
TEST(CornerTurn, ShortfallIsZeroWithoutTurn) {
    const ShapeTable shapes = {scenes::square_record()};
    Engine engine(scenes::exact(0.3), shapes, {scenes::floor(0.3)});
    engine.bodies().add(scenes::unit_square(shapes, 1, 0.0, 0.501));
    engine.bodies().add(scenes::unit_square(shapes, 2, 0.2, 1.503));
    engine.bodies().twist[1].velocity = {0.7, -0.3, 0.0};
    engine.step(0.01);
    const NarrowPhase table(shapes);
    std::vector<Twist> straight = engine.bodies().twist;
    for (Twist& twist : straight) twist.spin = {};
    for (const double shortfall : gap_shortfalls({engine.points(), engine.problem().contacts,
                                                  engine.bodies(), engine.walls(), straight, 0.01},
                                                 table))
        EXPECT_NEAR(shortfall, 0.0, 1e-16);
}

// Exact compared with a second detection: the corner of a falling, spinning triangle above a floor
// and above a spinning square.
TEST(CornerTurn, ForeseesTheGapAtTheEnd) {
    const ShapeTable shapes = {scenes::square_record(), {"triangle", {}}};
    EngineSettings settings = scenes::exact(0.0);
    settings.gravity = {};
    Engine engine(settings, shapes, {});
    engine.bodies().add(scenes::unit_square(shapes, 1, 0.0, 0.0, 0.1));
    engine.bodies().add(scenes::polygon(shapes, 1, 2, 0.05, 1.06, 0.5, 3.3));
    engine.bodies().twist[0] = {{0.1, 0.0, 0.0}, {0.0, 0.0, -2.0}};
    engine.bodies().twist[1] = {{1.0, 0.2, 0.0}, {0.0, 0.0, 1.5}};
    const double dt = 0.02;
    engine.step(dt);
    ASSERT_EQ(engine.points().size(), 1u);
    const ContactPoint point = engine.points()[0];
    ASSERT_NE(point.turns_with, 0);
    const NarrowPhase table(shapes);
    const double shortfall = gap_shortfalls({engine.points(),
                                             engine.problem().contacts,
                                             engine.bodies(),
                                             {},
                                             engine.bodies().twist,
                                             dt},
                                            table)[0];
    const double u = contact_velocity(engine.problem().contacts[0], engine.bodies().twist).n;
    engine.move(dt);
    const auto after = scenes::between(shapes, engine.bodies(), 0, 1, 0.5);
    ASSERT_EQ(after.size(), 1u);
    EXPECT_EQ(after[0].feature, point.feature);
    EXPECT_NEAR(point.gap + dt * u - shortfall, after[0].gap, 1e-14);
}

}  // namespace
}  // namespace turbidite::nscd
