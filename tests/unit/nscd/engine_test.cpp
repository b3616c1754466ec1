// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/engine/engine.hpp"

#include <gtest/gtest.h>

#include "coupler/rigid/vec3.hpp"
#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

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

// Over one step: change = weight dt + impulses at walls, each at the point where the disc touches.
// Contacts between grains cancel, in force and in moment. This holds even without convergence.
TEST(Engine, BalancesMomentumToRoundOff) {
    EngineSettings settings = scenes::exact(0.3, 1e-3);
    settings.solver_settings.max_iterations = 20;
    Engine engine = scenes::settling_pack(8, 8, settings);
    scenes::run(engine, 1.5, 0.01);
    const Bodies& b = engine.bodies();
    auto expected = momentum(b);
    engine.step(0.01);
    ASSERT_GT(engine.points().size(), 50u);
    for (std::size_t i = 0; i < b.size(); ++i) {
        const Vec3 weight{0.0, -b.weight_mass[i] * 0.01, 0.0};
        expected.first = expected.first + weight;
        expected.second = expected.second + cross(b.position[i], weight);
    }
    for (std::size_t k = 0; k < engine.points().size(); ++k) {
        const ContactPoint& point = engine.points()[k];
        if (point.wall < 0) continue;
        const Vec3 p = world_impulse(engine.problem().contacts[k], engine.impulses()[k]);
        expected.first = expected.first + p;
        expected.second = expected.second + cross(b.position[point.b] + point.arm_b, p);
    }
    const auto now = momentum(b);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(now.first[axis], expected.first[axis], 1e-12);
        EXPECT_NEAR(now.second[axis], expected.second[axis], 1e-12);
    }
}

// The impulses reported for each grain are those that changed its motion.
TEST(Engine, HandsOutTheImpulsesThatMovedTheGrains) {
    Engine engine = scenes::settling_pack(6, 6, scenes::exact(0.3, 1e-3));
    scenes::run(engine, 1.5, 0.01);
    const std::vector<Twist> before = engine.bodies().twist;
    engine.step(0.01);
    const Bodies& b = engine.bodies();
    for (std::size_t i = 0; i < b.size(); ++i) {
        const Vec3 change = b.mass[i] * (b.twist[i].velocity - before[i].velocity);
        EXPECT_NEAR(b.contact_impulse[i][0], change[0], 1e-13);
        EXPECT_NEAR(b.contact_impulse[i][1], change[1] + 0.01 * b.weight_mass[i], 1e-13);
        EXPECT_NEAR(b.contact_angular_impulse[i][2],
                    b.inertia[i].zz * (b.twist[i].spin[2] - before[i].spin[2]), 1e-13);
    }
}

// Mobilities given by the host replace those of the bodies; the impulse reported for each grain is
// A (U - U^F).
TEST(Engine, TakesTheHostsMobilities) {
    Engine engine = scenes::settling_pack(6, 6, scenes::exact(0.3, 1e-3));
    scenes::run(engine, 1.5, 0.01);
    std::vector<PlanarTensor> inertia;
    std::vector<BodyMobility> mobilities;
    std::vector<Twist> free = engine.bodies().twist;
    for (std::size_t i = 0; i < free.size(); ++i) {
        const double mass = engine.bodies().mass[i];
        PlanarTensor tensor(2.0 * mass, 3.0 * engine.bodies().inertia[i].zz);
        tensor.yy = 1.5 * mass;
        tensor.xy = 0.1 * mass * std::sin(double(i));
        tensor.xs = 0.02 * mass;
        inertia.push_back(tensor);
        mobilities.push_back(inverse(tensor).value());
        free[i].velocity[1] -= 0.005;
    }
    ASSERT_TRUE(engine.step_from(free, mobilities, 0.01).converged);
    const Bodies& b = engine.bodies();
    double largest = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i) {
        const Vec3 change = b.twist[i].velocity - free[i].velocity;
        const PlanarVector momentum =
            inertia[i] * PlanarVector{change[0], change[1], b.twist[i].spin[2] - free[i].spin[2]};
        EXPECT_NEAR(momentum.x, b.contact_impulse[i][0], 1e-12);
        EXPECT_NEAR(momentum.y, b.contact_impulse[i][1], 1e-12);
        EXPECT_NEAR(momentum.spin, b.contact_angular_impulse[i][2], 1e-12);
        largest = std::max(largest, norm(b.contact_impulse[i]));
    }
    EXPECT_GT(largest, 1e-3) << "there must be contacts, or this tests nothing";
    EXPECT_THROW(engine.step_from(free, std::vector<BodyMobility>(3), 0.01), std::invalid_argument);
}

// A second solve of the same problem starts from the first solution: converged at the first check.
TEST(Engine, ARepeatedStepIsWarmStarted) {
    Engine engine = scenes::settling_pack(8, 8, scenes::exact(0.3, 1e-6));
    scenes::run(engine, 1.0, 0.01);
    const std::vector<Twist> free = engine.bodies().twist;
    std::vector<BodyMobility> mobilities;
    for (std::size_t i = 0; i < free.size(); ++i)
        mobilities.push_back({0.5 / engine.bodies().mass[i], 0.5 / engine.bodies().inertia[i].zz});
    std::vector<Twist> falling = free;
    for (Twist& twist : falling) twist.velocity[1] -= 0.01;
    const StepReport first = engine.step_from(falling, mobilities, 0.01);
    engine.bodies().twist = free;
    const StepReport second = engine.step_from(falling, mobilities, 0.01);
    EXPECT_GT(first.iterations, 10);
    EXPECT_LE(second.iterations, 2);
}

// r_n >= 0, |r_t| <= mu r_n, u_n + b_n >= 0 for every contact, to the solver's tolerance.
TEST(Engine, ContactsAreAdmissible) {
    Engine engine = scenes::settling_pack(8, 8, scenes::exact(0.3, 1e-9));
    EXPECT_TRUE(scenes::run(engine, 1.0, 0.01));
    engine.step(0.01);
    for (std::size_t k = 0; k < engine.points().size(); ++k) {
        const Contact& contact = engine.problem().contacts[k];
        const ContactVector u = contact_velocity(contact, engine.bodies().twist),
                            r = engine.impulses()[k];
        EXPECT_GE(r.n, 0.0);
        EXPECT_LE(std::abs(r.t), 0.3 * r.n * (1 + 1e-15));
        EXPECT_GE(u.n + contact.bias.n, -1e-7);
        EXPECT_LE(std::abs((u.n + contact.bias.n) * r.n), 1e-8);
    }
}

// Discs fall into a box and come to rest: the last ones roll down by t = 13. Positions follow the
// contact velocities, so the overlap is the error allowed by the tolerance: 6e-5 over several
// packings at dt = 0.02 with this tolerance, up to 1.5e-4 with 1e-3, whatever the order of the
// sweeps.
TEST(Engine, SettlesWithoutOverlap) {
    for (const double dt : {0.02, 0.01, 0.005}) {
        EngineSettings settings = scenes::exact(0.3, 5e-4);
        settings.solver_settings.max_iterations = 2000;
        Engine engine = scenes::settling_pack(10, 10, settings);
        double deepest = 0.0;
        for (int n = 0; n * dt < 14.0; ++n) {
            EXPECT_TRUE(engine.step(dt).converged);
            engine.move(dt);
            deepest = std::max(deepest, engine.max_penetration());
        }
        EXPECT_LT(deepest, 1e-4);
        double speed = 0.0;
        for (const Twist& twist : engine.bodies().twist) speed += norm(twist.velocity) / 100.0;
        EXPECT_LT(speed, 0.01);
    }
}

TEST(Engine, RepeatsItselfBitForBit) {
    const auto result = [] {
        Engine engine = scenes::settling_pack(8, 8, scenes::exact(0.3, 1e-3));
        scenes::run(engine, 2.0, 0.01);
        return engine.save();
    };
    EXPECT_EQ(result(), result());
}

// 100 + 100 steps with a save in between equal 200 steps, bit for bit: impulses are part of the
// state.
TEST(Engine, RestartsBitForBit) {
    const EngineSettings settings = scenes::exact(0.3, 1e-3);
    Engine whole = scenes::settling_pack(8, 8, settings);
    scenes::run(whole, 1.0, 0.01);
    const std::vector<char> middle = whole.save();
    scenes::run(whole, 1.0, 0.01);

    Engine second(settings, scenes::discs, whole.walls());
    second.restore(middle);
    EXPECT_EQ(second.save(), middle);
    scenes::run(second, 1.0, 0.01);
    EXPECT_EQ(second.save(), whole.save());

    Engine forgetful(settings, scenes::discs, whole.walls());
    forgetful.restore(middle);
    forgetful.memory().forget();
    scenes::run(forgetful, 1.0, 0.01);
    EXPECT_NE(forgetful.save(), whole.save()) << "the memory must matter, or this tests nothing";
}

TEST(Engine, RefusesBrokenStates) {
    Engine engine = scenes::settling_pack(2, 2, scenes::exact(0.3));
    std::vector<char> state = engine.save();
    state.pop_back();
    EXPECT_THROW(engine.restore(state), std::invalid_argument);
    EXPECT_THROW(engine.restore({'n', 'o'}), std::invalid_argument);
    EXPECT_THROW(engine.restore(engine.save_memory()), std::invalid_argument);
    EXPECT_EQ(engine.bodies().size(), 4u) << "a refused state changes nothing";
}

// Bodies keep their order; contacts of the remaining bodies keep their impulses.
TEST(Engine, ForgetsOnlyRemovedBodies) {
    Engine engine = scenes::settling_pack(3, 1, scenes::exact(0.3));
    scenes::run(engine, 1.0, 0.01);
    const std::size_t before = engine.memory().contacts().size();
    engine.keep({1, 0, 1});
    EXPECT_EQ(engine.bodies().id, (std::vector<GrainId>{0, 2}));
    EXPECT_EQ(engine.bodies().contact_impulse.size(), 2u);
    EXPECT_EQ(engine.memory().contacts().size(), before);
    EXPECT_TRUE(engine.step(0.01).converged);
    EXPECT_EQ(engine.memory().contacts().size(), 2u);
}

// Discs that fall side by side, touching, without support: solved at once, with contact forces at
// rounding level.
TEST(Engine, FallingLatticeCountsAsSolved) {
    Engine engine(scenes::exact(0.3, 1e-3), scenes::discs, {});
    for (int k = 0; k < 30; ++k)
        engine.bodies().add(scenes::disc(k, k % 6 + 0.5 * (k / 6 % 2), std::sqrt(0.75) * (k / 6)));
    for (int n = 0; n < 20; ++n) {
        const StepReport report = engine.step(0.01);
        EXPECT_TRUE(report.converged);
        EXPECT_LT(report.iterations, 300);
        engine.move(0.01);
    }
    for (const Vec3& impulse : engine.bodies().contact_impulse) EXPECT_LT(norm(impulse), 1e-12);
}

// A disc on the floor, pressed by g dt m, and one 0.002 above it: b = 0.2, no impulse. What is off
// is the velocity that the floor should stop, or the impulse that nothing presses, as a velocity.
TEST(Engine, ContactViolationIsThatOfTheVelocitiesAtTheEnd) {
    Engine engine(scenes::exact(0.0), scenes::discs, {scenes::floor(0.0)});
    engine.bodies().add(scenes::disc(1, 0.0, 0.5));
    engine.bodies().add(scenes::disc(2, 3.0, 0.502));
    engine.step(0.01);
    EXPECT_LT(engine.contact_violation(), 1e-12);
    const auto with = [&](double first, double second) {
        engine.bodies().twist[0].velocity = {0.7, first, 0.0};
        engine.bodies().twist[1].velocity = {-0.7, second, 0.0};
        return engine.contact_violation();
    };
    EXPECT_NEAR(with(-0.3, 0.0), 0.3, 1e-12);
    EXPECT_NEAR(with(0.004, 0.0), 0.004, 1e-12);
    EXPECT_NEAR(with(0.5, 0.0), 0.01, 1e-12);
    EXPECT_NEAR(with(0.0, -0.2), 0.0, 1e-12);
    EXPECT_NEAR(with(0.0, -0.5), 0.3, 1e-12);
    EXPECT_NEAR(with(0.0, 0.5), 0.0, 1e-12);
}

TEST(Engine, RefusesBadSettings) {
    EngineSettings settings;
    settings.theta = 0.4;
    EXPECT_THROW(Engine(settings, scenes::discs, {}), std::invalid_argument);
    settings = {};
    settings.friction = -0.1;
    EXPECT_THROW(Engine(settings, scenes::discs, {}), std::invalid_argument);
    Wall slanted = scenes::floor(0.3);
    slanted.normal = {0.5, 0.5, 0.0};
    EXPECT_THROW(Engine({}, scenes::discs, {slanted}), std::invalid_argument);
    Engine engine({}, scenes::discs, {});
    EXPECT_THROW(engine.step(0.0), std::invalid_argument);
}

// The pairs detected by the step suffice for the overlap after it, unless a body moves farther than
// the step searched: here a grain with a speed that no body had, through a neighbour that was far
// away.
TEST(Engine, ReportsTheOverlapAfterTheMotionWithoutNewDetection) {
    Engine engine = scenes::settling_pack(6, 8, scenes::exact(0.3, 1e-3));
    double deepest = 0.0;
    for (int n = 0; n < 300; ++n) {
        engine.step(0.01);
        engine.move(0.01);
        EXPECT_EQ(engine.max_penetration_after_move(), engine.max_penetration());
        deepest = std::max(deepest, engine.max_penetration());
    }
    EXPECT_GT(deepest, 0.0) << "nothing overlapped: this compared zeros";
    engine.step(0.01);
    std::vector<Twist> thrown = engine.bodies().twist;
    thrown[0].velocity = {200.0, 0.0, 0.0};
    engine.move(0.01, thrown);
    EXPECT_GT(engine.max_penetration(), 0.1);
    EXPECT_EQ(engine.max_penetration_after_move(), engine.max_penetration());
    engine.keep(std::vector<std::uint8_t>(engine.bodies().size(), 1));
    EXPECT_EQ(engine.max_penetration_after_move(), engine.max_penetration());
}

TEST(Engine, ReportsTheOverlapThatTheStepBeganWith) {
    Engine engine(scenes::exact(0.3), scenes::discs, {scenes::floor(0.3)});
    engine.bodies().add(scenes::disc(1, 0.0, 0.49));
    engine.bodies().add(scenes::disc(2, 0.0, 1.47));
    const double before = engine.max_penetration();
    EXPECT_NEAR(before, 0.02, 1e-15);
    EXPECT_EQ(engine.step(0.01).max_penetration, before);
}

}  // namespace
}  // namespace turbidite::nscd
