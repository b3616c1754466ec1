// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Attractive laws: a disc (m = pi/4, R = 1/2) beside a fixed one, without weight, pulled along +x
// by a force. Adhesion c = 2, range 0.05.
#include <gtest/gtest.h>

#include "coupler/rigid/vec3.hpp"
#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

constexpr double c = 2.0, range = 0.05, dt = 0.01;
const double mass = std::numbers::pi / 4;

EngineSettings adhesive(const std::string& law) {
    return scenes::adhesive(law, c, range);
}

/// The fixed disc at the origin, the free one at a gap to its right.
Engine pair_at(double gap, const EngineSettings& settings, double radius = 0.5) {
    Engine engine(settings, scenes::discs, {});
    engine.bodies().add(scenes::disc(1, 0.0, 0.0));
    engine.bodies().add(scenes::disc(2, 0.5 + radius + gap, 0.0, radius));
    engine.bodies().fixed[0] = 1;
    engine.bodies().rotation_blocked[1] = 1;
    return engine;
}

/// Velocity of the free disc after some steps under a force.
Vec3 pulled(Engine& engine, const Vec3& force, int steps) {
    engine.bodies().force[1] = force;
    EXPECT_TRUE(scenes::run(engine, steps * dt, dt));
    return engine.bodies().twist[1].velocity;
}

double pulled_right(Engine& engine, double force, int steps) {
    return pulled(engine, {force, 0.0, 0.0}, steps)[0];
}

/// Force on the free disc at a gap, with the present state of its law.
double force_at(Engine& engine, double gap) {
    engine.bodies().position[1] = {0.5 + engine.bodies().radius[1] + gap, 0.0, 0.0};
    engine.bodies().twist[1] = {};
    engine.bodies().force[1] = {};
    engine.step(dt);
    const double force = engine.bodies().contact_impulse[1][0] / dt;
    engine.move(dt, std::vector<Twist>(2));
    engine.bodies().twist[1] = {};
    return force;
}

TEST(Wet, HoldsUpToExactlyItsForce) {
    for (const char* law : {"wet", "wet-irreversible"}) {
        Engine holds = pair_at(0.0, adhesive(law));
        EXPECT_NEAR(pulled_right(holds, c * (1 - 1e-9), 50), 0.0, 1e-13);
        EXPECT_NEAR(holds.bodies().contact_impulse[1][0], -c * dt, 1e-9) << "the real force";
        EXPECT_NEAR(holds.impulses()[0].n, -c * dt, 1e-9);
        EXPECT_NEAR(holds.solution()[0].n, 0.0, 1e-9) << "what the solver found";
        Engine parts = pair_at(0.0, adhesive(law));
        EXPECT_NEAR(pulled_right(parts, c + 0.1, 50), 50 * dt * 0.1 / mass, 1e-12);
    }
}

// At a distance the acceleration is c/m; the pair closes without overlap and then presses with c
// alone.
TEST(Wet, PullsWithinItsRange) {
    Engine engine = pair_at(0.04, adhesive("wet"));
    EXPECT_NEAR(pulled_right(engine, 0.0, 1), -dt * c / mass, 1e-13);
    EXPECT_NEAR(pulled_right(engine, 0.0, 100), 0.0, 1e-13);
    EXPECT_NEAR(engine.bodies().position[1][0], 1.0, 1e-12);
    EXPECT_NEAR(engine.solution()[0].n, c * dt, 1e-12);
    EXPECT_NEAR(engine.bodies().contact_impulse[1][0], 0.0, 1e-12);
    Engine beyond = pair_at(0.0501, adhesive("wet"));
    EXPECT_EQ(pulled_right(beyond, 0.0, 10), 0.0);
}

TEST(Wet, IrreversibleOneIsLostBeyondTheRange) {
    for (const bool once : {false, true}) {
        Engine engine = pair_at(0.0, adhesive(once ? "wet-irreversible" : "wet"));
        EXPECT_NEAR(force_at(engine, 0.04), -c, 1e-12);
        EXPECT_NEAR(force_at(engine, 0.06), 0.0, 1e-15);
        EXPECT_NEAR(force_at(engine, 0.04), once ? 0.0 : -c, 1e-12);
    }
}

// c sqrt(R1 R2)/R exp(-g/0.02); at a wall 2 R.
TEST(Capillary, FollowsItsCurveAndRuptures) {
    for (const double radius : {0.5, 0.25}) {
        Engine engine = pair_at(0.0, adhesive("capillary"), radius);
        pulled_right(engine, 0.0, 1);
        const double top = c * std::sqrt(0.5 * radius) / 0.5;
        for (const double gap : {0.001, 0.01, 0.03, 0.0499})
            EXPECT_NEAR(force_at(engine, gap), -top * std::exp(-gap / 0.02), 1e-12) << gap;
        EXPECT_NEAR(force_at(engine, 0.0501), 0.0, 1e-15) << "ruptured";
        EXPECT_NEAR(force_at(engine, 0.01), 0.0, 1e-15) << "forms on contact only";
        force_at(engine, 0.0);
        EXPECT_NEAR(force_at(engine, 0.01), -top * std::exp(-0.5), 1e-12) << "formed again";
    }
}

TEST(Capillary, HasNoBridgeBeforeTheFirstContact) {
    Engine engine = pair_at(0.01, adhesive("capillary"));
    EXPECT_EQ(force_at(engine, 0.01), 0.0);
}

TEST(Capillary, HoldsADiscUnderACeiling) {
    EngineSettings settings = adhesive("capillary");
    for (const double force : {2.0 * c - 1e-6, 2.0 * c + 1e-6}) {
        Engine engine(settings, scenes::discs, {scenes::wall(1, {0, 1, 0}, {0, -1, 0}, 0.0)});
        engine.bodies().add(scenes::disc(1, 0.0, 0.5));
        engine.bodies().force[0] = {0.0, -force, 0.0};
        scenes::run(engine, 1.0, dt);
        EXPECT_EQ(engine.bodies().position[0][1]<0.5 - 1e-8, force> 2.0 * c);
    }
}

TEST(Cohesion, BreaksInTractionAtItsStrength) {
    Engine holds = pair_at(0.0, adhesive("cohesion"));
    EXPECT_NEAR(pulled_right(holds, c * (1 - 1e-9), 50), 0.0, 1e-13);
    Engine breaks = pair_at(0.0, adhesive("cohesion"));
    const double first = dt * 0.1 / mass;
    EXPECT_NEAR(pulled_right(breaks, c + 0.1, 1), first, 1e-13);
    EXPECT_NEAR(pulled_right(breaks, c + 0.1, 1), first + dt * (c + 0.1) / mass, 1e-12)
        << "nothing holds it any more";
}

// Shear strength 0.5 c; under a pressure p it holds 0.5 (c + p).
TEST(Cohesion, BreaksInShearAtItsStrength) {
    for (const double pressure : {0.0, 3.0}) {
        const double strength = 0.5 * (c + pressure);
        Engine holds = pair_at(0.0, adhesive("cohesion"));
        EXPECT_NEAR(pulled(holds, {-pressure, strength * (1 - 1e-9), 0.0}, 50)[1], 0.0, 1e-13);
        Engine breaks = pair_at(0.0, adhesive("cohesion"));
        EXPECT_NEAR(pulled(breaks, {-pressure, strength + 0.1, 0.0}, 1)[1], dt * 0.1 / mass, 1e-13);
        const Vec3 second = pulled(breaks, {-pressure, strength + 0.1, 0.0}, 1);
        EXPECT_NEAR(second[1], dt * (strength + 0.2) / mass, 1e-4) << "no friction is left";
    }
}

// A face of length 0.3 holds 0.3 of the bond of a unit length; a corner has no bond.
TEST(Cohesion, OfAFaceGoesWithItsLength) {
    const SurfaceTable surfaces(adhesive("cohesion").surfaces);
    const auto law =
        make_law_part(LawSlot::adhesion, "cohesion", adhesive("cohesion").law_settings, surfaces);
    ContactSituation situation;
    situation.surface = surfaces.pair(0, 0);
    situation.radius_a = situation.radius_b = 0.5;
    situation.initial = true;
    const auto pull = [&] {
        LawTerms terms;
        law->add(situation, terms);
        return terms.attraction;
    };
    EXPECT_NEAR(pull(), c, 1e-15);
    situation.radius_a = 0.2;
    EXPECT_NEAR(pull(), 0.4 * c, 1e-15);
    situation.round = false;
    EXPECT_EQ(pull(), 0.0);
    situation.length = 0.3;
    EXPECT_NEAR(pull(), 0.3 * c, 1e-15);
}

TEST(Cohesion, BondsAreMadeInTheFirstStepOnlyAndStayBroken) {
    Engine engine = pair_at(0.0, adhesive("cohesion"));
    pulled_right(engine, 1.5 * c, 2);
    for (const double gap : {0.0, 0.001, 0.0}) EXPECT_GE(force_at(engine, gap), -1e-13);
    Engine second = pair_at(0.0, adhesive("cohesion"));
    second.restore(engine.save());
    EXPECT_GE(force_at(second, 0.001), -1e-13) << "broken, also after a restart";
    Engine late = pair_at(0.2, adhesive("cohesion"));
    force_at(late, 0.2);
    EXPECT_GE(force_at(late, 0.0), -1e-13);
    EXPECT_NEAR(pulled_right(late, 0.1, 1), dt * 0.1 / mass, 1e-13);
}

TEST(Cohesion, AnIntactBondSurvivesARestart) {
    for (const bool memory_only : {false, true}) {
        Engine engine = pair_at(0.0, adhesive("cohesion"));
        pulled_right(engine, 0.5 * c, 3);
        Engine second = pair_at(0.0, adhesive("cohesion"));
        if (memory_only)
            second.restore_memory(engine.save_memory());
        else
            second.restore(engine.save());
        EXPECT_NEAR(pulled_right(second, 0.999 * c, 20), 0.0, 1e-13);
        EXPECT_GT(pulled_right(second, 1.001 * c, 1), 1e-6);
    }
}

// A bond across a gap preserves the gap.
TEST(Cohesion, KeepsTheGapItWasMadeAt) {
    Engine engine = pair_at(0.01, adhesive("cohesion"));
    EXPECT_NEAR(pulled_right(engine, 0.9 * c, 20), 0.0, 1e-13);
    EXPECT_NEAR(pulled_right(engine, -3.0 * c, 20), 0.0, 1e-13);
    EXPECT_NEAR(engine.bodies().position[1][0], 1.01, 1e-12);
}

// In a window of `joint` the step is repeated before the move: a bond that broke in the first round
// is intact again in the second, and breaks for good only in the last.
TEST(Adhesion, RoundsOfAStepStartFromTheSameStates) {
    Engine engine = pair_at(0.0, adhesive("cohesion"));
    const std::vector<BodyMobility> mobilities = {{0.0, 0.0}, {0.5, 0.0}};
    const auto round = [&](double speed) {
        engine.bodies().twist[1] = {};
        std::vector<Twist> free(2);
        free[1].velocity = {speed, 0.0, 0.0};
        engine.step_from(free, mobilities, dt);
        return engine.bodies().twist[1].velocity[0];
    };
    // W = 1/2: the bond reduces the speed by at most c dt/2 = 0.01.
    EXPECT_NEAR(round(0.015), 0.005, 1e-13);
    EXPECT_NEAR(round(0.0099), 0.0, 1e-13);
    engine.move(dt);
    EXPECT_NEAR(round(0.0099), 0.0, 1e-13);
    EXPECT_NEAR(round(0.015), 0.005, 1e-13);
    engine.move(dt, std::vector<Twist>(2));
    EXPECT_NEAR(round(0.0099), 0.0099, 1e-13);
}

// Mobilities of the host with coupled directions: A (U - U^F) equals the impulse reported for the
// grain, attraction included.
TEST(Adhesion, ImpulsesBalanceUnderTheHostsMobilities) {
    EngineSettings settings = adhesive("wet");
    settings.surfaces[0].friction = 0.3;
    settings.solver_settings.tolerance = 1e-6;
    Engine engine = scenes::settling_pack(6, 6, settings);
    PlanarTensor inertia(2.0, 0.3);
    inertia.yy = 1.5, inertia.xy = 0.1, inertia.xs = 0.02;
    double most = 0.0;
    for (int n = 0; n < 150; ++n) {
        std::vector<Twist> free = engine.bodies().twist;
        for (Twist& twist : free) twist.velocity[1] -= dt;
        engine.step_from(free, std::vector<BodyMobility>(free.size(), inverse(inertia).value()),
                         dt);
        const Bodies& b = engine.bodies();
        for (std::size_t i = 0; i < b.size(); ++i) {
            const Vec3 change = b.twist[i].velocity - free[i].velocity;
            const double turn = b.twist[i].spin[2] - free[i].spin[2];
            const PlanarVector momentum = inertia * PlanarVector{change[0], change[1], turn};
            EXPECT_NEAR(momentum.x, b.contact_impulse[i][0], 1e-12);
            EXPECT_NEAR(momentum.y, b.contact_impulse[i][1], 1e-12);
            EXPECT_NEAR(momentum.spin, b.contact_angular_impulse[i][2], 1e-12);
        }
        for (const ContactVector& r : engine.impulses()) most = std::max(most, -r.n);
        engine.move(dt);
    }
    EXPECT_GT(most, 0.1 * c * dt) << "some pair must be pulled, or this tests nothing";
}

// All slots at once; the saved state includes the law's states, bit for bit.
TEST(Adhesion, RestartsBitForBitWithStates) {
    EngineSettings settings = adhesive("capillary");
    settings.gravity = {0.0, -1.0, 0.0};
    settings.solver_settings.tolerance = 1e-3;
    settings.law.friction = "static-dynamic";
    settings.law.impact = "moreau";
    settings.surfaces[0].friction = 0.3;
    settings.surfaces[0].static_friction = 0.5;
    settings.surfaces[0].restitution = 0.5;
    settings.surfaces[0].adhesion = 0.3;
    Engine whole = scenes::settling_pack(6, 6, settings);
    scenes::run(whole, 1.0, dt);
    const std::vector<char> middle = whole.save();
    scenes::run(whole, 1.0, dt);
    Engine second(settings, scenes::discs, whole.walls());
    second.restore(middle);
    EXPECT_EQ(second.save(), middle);
    scenes::run(second, 1.0, dt);
    EXPECT_EQ(second.save(), whole.save());
}

TEST(Adhesion, RefusesMissingParametersByName) {
    const auto refusal = [](const std::string& law, auto spoil) -> std::string {
        EngineSettings settings = adhesive(law);
        spoil(settings);
        try {
            Engine(settings, scenes::discs, {});
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "";
    };
    for (const char* law : {"cohesion", "wet", "wet-irreversible", "capillary"}) {
        const std::string range_text =
            refusal(law, [](auto& s) { s.law_settings.adhesion_range = 0.0; });
        EXPECT_NE(range_text.find(std::string(law) + "\": range"), std::string::npos) << range_text;
        const std::string force = refusal(law, [](auto& s) { s.surfaces[0].adhesion = 0.0; });
        EXPECT_NE(force.find("adhesion"), std::string::npos) << force;
    }
    EXPECT_NE(
        refusal("cohesion", [](auto& s) { s.law_settings.adhesion_shear = 0.0; }).find("shear"),
        std::string::npos);
    EXPECT_NE(refusal("capillary", [](auto& s) { s.law_settings.adhesion_length = 0.0; })
                  .find("decay length"),
              std::string::npos);
    EXPECT_NE(refusal("glue", [](auto&) {}).find("known: none, cohesion, wet"), std::string::npos);
}

}  // namespace
}  // namespace turbidite::nscd
