// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The engine in space: what it refuses, what it conserves, what it remembers.
#include <gtest/gtest.h>

#include "granular_adapter/nscd/problem/turned_frames.hpp"
#include "granular_adapter/nscd/solvers/nlgs.hpp"
#include "spheres.hpp"

namespace turbidite::nscd {
namespace {

/// The message of the exception, or nothing.
template <class Call>
std::string refusal(const Call& call) {
    try {
        call();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

std::string refused_engine(int dimension, const ShapeTable& shapes,
                           const std::string& solver = "nlgs", std::vector<Wall> walls = {}) {
    EngineSettings settings;
    settings.dimension = dimension;
    settings.solver = solver;
    return refusal([&] { Engine(settings, shapes, walls); });
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(SpaceEngine, RefusesWhatIsOfAnotherDimension) {
    EXPECT_EQ(refused_engine(3, scenes::spheres), "");
    EXPECT_EQ(refused_engine(2, scenes::discs), "");
    const std::string disc = refused_engine(3, scenes::discs);
    EXPECT_TRUE(contains(disc, "\"disc\"") && contains(disc, "grains.shape: sphere")) << disc;
    const std::string sphere = refused_engine(2, scenes::spheres);
    EXPECT_TRUE(contains(sphere, "\"sphere\"") && contains(sphere, "dimension: 3")) << sphere;
    EXPECT_TRUE(contains(refused_engine(4, scenes::spheres), "dimension = 4"));
    EXPECT_NE(refused_engine(3, {{"sphere", {}}, {"triangle", {}}}), "");
    const std::string path = refused_engine(3, scenes::spheres, "central-path");
    EXPECT_TRUE(contains(path, "central-path") && contains(path, "nlgs")) << path;
    Wall segment = scenes::wall(8, {}, {0, 1, 0}, 0.3);
    segment.half_length = 2.0;
    const std::string wall = refused_engine(3, scenes::spheres, "nlgs", {segment});
    EXPECT_TRUE(contains(wall, "wall 8") && contains(wall, "half_length = 2")) << wall;
}

TEST(SpaceEngine, RefusesMobilitiesOfThePlane) {
    Engine engine(scenes::exact_in_space(0.3), scenes::spheres, {scenes::floor(0.3)});
    engine.bodies().add(scenes::sphere(1, {0.0, 0.5, 0.0}));
    const std::vector<Twist> free(1);
    EXPECT_TRUE(
        contains(refusal([&] { engine.step_from(free, std::vector<PlanarTensor>(1), 0.01); }),
                 "dimension 2"));
    EXPECT_NO_THROW(engine.step_from(free, std::vector<SpaceMobility>{{1.0, 2.0}}, 0.01));
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

// Over one step: change = weight dt + impulses at walls, each at the point where the sphere
// touches. Contacts between grains cancel, in force and in moment, also without convergence.
TEST(SpaceEngine, BalancesMomentumToRoundOff) {
    EngineSettings settings = scenes::exact_in_space(0.3, 1e-3);
    settings.solver_settings.max_iterations = 20;
    Engine engine = scenes::settling_spheres(5, 5, settings);
    scenes::run(engine, 1.0, 0.01);
    const Bodies& b = engine.bodies();
    auto expected = momentum(b);
    engine.step(0.01);
    ASSERT_GT(engine.memory().contacts().size(), 60u);
    for (std::size_t i = 0; i < b.size(); ++i) {
        const Vec3 weight{0.0, -b.weight_mass[i] * 0.01, 0.0};
        expected.first = expected.first + weight;
        expected.second = expected.second + cross(b.position[i], weight);
    }
    double friction = 0.0;
    for (std::size_t k = 0; k < engine.points().size(); ++k) {
        friction = std::max(friction, tangential(engine.impulses()[k]));
        const ContactPoint& point = engine.points()[k];
        if (point.wall < 0) continue;
        const Vec3 p = world_impulse(engine.problem().contacts[k], engine.impulses()[k]);
        expected.first = expected.first + p;
        expected.second = expected.second + cross(b.position[point.b] + point.arm_b, p);
    }
    EXPECT_GT(friction, 1e-4);
    const auto now = momentum(b);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(now.first[axis], expected.first[axis], 1e-12);
        EXPECT_NEAR(now.second[axis], expected.second[axis], 1e-12);
    }
}

// Free spheres that collide without gravity: both are constant over many steps.
TEST(SpaceEngine, ConservesMomentumOverCollisions) {
    EngineSettings settings = scenes::exact_in_space(0.5, 1e-12);
    settings.gravity = {};
    Engine engine(settings, scenes::spheres, {});
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int i = 0; i < 27; ++i) {
        Body body = scenes::sphere(i + 1, {1.2 * (i % 3), 1.2 * (i / 3 % 3), 1.2 * (i / 9)},
                                   0.5 + 0.08 * any(random));
        body.twist.velocity = Vec3{any(random), any(random), any(random)} -
                              0.8 * (body.position - Vec3{1.2, 1.2, 1.2});
        body.twist.spin = {any(random), any(random), any(random)};
        engine.bodies().add(body);
    }
    const auto before = momentum(engine.bodies());
    const double energy = scenes::kinetic_energy(engine.bodies());
    EXPECT_TRUE(scenes::run(engine, 2.0, 0.01));
    const auto after = momentum(engine.bodies());
    EXPECT_LT(scenes::kinetic_energy(engine.bodies()), 0.8 * energy) << "they collided";
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(after.first[axis], before.first[axis], 1e-12);
        // q moves with the velocities at the end of the step: contacts act at q, free motion is
        // straight, so the sum about the origin is exact too.
        EXPECT_NEAR(after.second[axis], before.second[axis], 1e-12);
    }
}

// The impulses reported for each grain are those that changed its motion.
TEST(SpaceEngine, HandsOutTheImpulsesThatMovedTheGrains) {
    Engine engine = scenes::settling_spheres(4, 4, scenes::exact_in_space(0.3, 1e-3));
    scenes::run(engine, 1.0, 0.01);
    const std::vector<Twist> before = engine.bodies().twist;
    engine.step(0.01);
    const Bodies& b = engine.bodies();
    double turned = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i) {
        const Vec3 change = b.mass[i] * (b.twist[i].velocity - before[i].velocity);
        const Vec3 turn = b.inertia[i].xx * (b.twist[i].spin - before[i].spin);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double weight = axis == 1 ? 0.01 * b.weight_mass[i] : 0.0;
            EXPECT_NEAR(b.contact_impulse[i][axis], change[axis] + weight, 1e-13);
            EXPECT_NEAR(b.contact_angular_impulse[i][axis], turn[axis], 1e-13);
        }
        turned = std::max(turned, norm(turn));
    }
    EXPECT_GT(turned, 1e-5);
}

// r_n >= 0, |r_t| <= mu r_n, u_n + b_n >= 0 for every contact, to the solver's tolerance.
TEST(SpaceEngine, ContactsAreAdmissible) {
    Engine engine = scenes::settling_spheres(4, 5, scenes::exact_in_space(0.3, 1e-9));
    EXPECT_TRUE(scenes::run(engine, 1.0, 0.01));
    int loaded = 0;
    for (std::size_t k = 0; k < engine.points().size(); ++k) {
        const Contact& contact = engine.problem().contacts[k];
        const ContactVector u = contact_velocity(contact, engine.bodies().twist);
        const ContactVector r = engine.impulses()[k];
        EXPECT_GE(r.n, 0.0);
        EXPECT_LE(tangential(r), contact.friction * r.n * (1.0 + 1e-12));
        EXPECT_GE(u.n + contact.bias.n, -1e-7);
        loaded += r.n > 0.0;
    }
    EXPECT_GT(loaded, 50);
}

// A second solve of the same problem starts from the first solution.
TEST(SpaceEngine, ARepeatedStepIsWarmStarted) {
    Engine engine = scenes::settling_spheres(5, 5, scenes::exact_in_space(0.3, 1e-6));
    scenes::run(engine, 1.5, 0.01);
    const std::vector<Twist> free = engine.bodies().twist;
    std::vector<Twist> falling = free;
    for (Twist& twist : falling) twist.velocity[1] -= 0.01;
    const StepReport first = engine.step_from(falling, 0.01);
    engine.bodies().twist = free;
    const StepReport second = engine.step_from(falling, 0.01);
    EXPECT_GT(first.iterations, 10);
    EXPECT_LE(second.iterations, 2);
}

// A tangential impulse keeps its direction in the world when the normal passes e_z, where the frame
// jumps.
TEST(TurnedFrames, TangentialImpulsesKeepTheirDirection) {
    const auto contact_of = [](double x) {
        Contact contact;
        contact.normal = (1.0 / std::sqrt(1.0 + x * x)) * Vec3{x, 0.0, 1.0};
        contact.tangent = tangent_of(contact.normal);
        return contact;
    };
    const Contact before = contact_of(-1e-6), after = contact_of(1e-6);
    EXPECT_LT(dot(before.tangent, after.tangent), -0.99) << "the frame turns round";
    const ContactVector r{2.0, 0.3, -0.7, 0.0};
    const ContactVector kept = in_world_axes(before, r);
    const ContactVector next = from_world_axes(after, kept);
    EXPECT_EQ(next.n, 2.0);
    const Vec3 change = world_impulse(after, next) - world_impulse(before, r);
    EXPECT_LT(norm(change), 1e-5);
    EXPECT_LT(std::abs(tangential(next) - tangential(r)), 1e-5);
    // A larger turn: what is along the new normal is left out.
    const Contact turned = contact_of(1.0);
    const ContactVector along =
        from_world_axes(turned, in_world_axes(before, {1.0, 0.0, 1.0, 0.0}));
    EXPECT_LT(tangential(along), 1.0 + 1e-12);
    EXPECT_EQ(in_frame(turned, world_impulse(turned, along)).roll, 0.0);
}

// Impulses are remembered over a turn of the pair: a sphere that rolls over another one.
TEST(SpaceEngine, TheWarmStartFollowsATurningContact) {
    EngineSettings settings = scenes::exact_in_space(1.0, 1e-10);
    Engine engine(settings, scenes::spheres, {});
    engine.bodies().add(scenes::sphere(1, {0.0, 0.0, 0.0}));
    engine.bodies().add(scenes::sphere(2, {0.05, 1.0, 0.05}));
    engine.bodies().fixed[0] = 1;
    for (int n = 0; n < 100; ++n) {
        engine.step(0.01);
        if (n > 20 && !engine.points().empty() && engine.guess()[0].n > 0.0) {
            const Contact& contact = engine.problem().contacts[0];
            const Vec3 guess = world_impulse(contact, engine.guess()[0]);
            const Vec3 found = world_impulse(contact, engine.solution()[0]);
            EXPECT_LT(norm(found - guess), 0.1 * norm(found)) << n;
        }
        engine.move(0.01);
    }
    EXPECT_GT(norm(engine.bodies().twist[1].spin), 0.1) << "it rolls";
}

std::unique_ptr<const ContactSolver> make_portable() {
    return std::make_unique<Nlgs>(Instructions::portable);
}

// With and without AVX2 the whole state is the same after a fall and a rest.
TEST(SpaceEngine, InstructionSetsDoNotChangeABit) {
    std::vector<SolverEntry> solvers(solver_list().begin(), solver_list().end());
    solvers.push_back({"portable", "for any processor", make_portable});
    EngineSettings settings = scenes::exact_in_space(0.3, 1e-4);
    Engine fast = scenes::settling_spheres(5, 6, settings);
    settings.solvers = solvers;
    settings.solver = "portable";
    Engine portable = scenes::settling_spheres(5, 6, settings);
    scenes::run(fast, 1.5, 0.01);
    scenes::run(portable, 1.5, 0.01);
    EXPECT_GT(fast.memory().contacts().size(), 100u);
    EXPECT_EQ(fast.save(), portable.save());
}

// A saved engine goes on as if it had not been interrupted.
TEST(SpaceEngine, ARestoredStateGoesOnWithTheSameBits) {
    EngineSettings settings = scenes::exact_in_space(0.3, 1e-4);
    Engine engine = scenes::settling_spheres(4, 5, settings);
    scenes::run(engine, 1.0, 0.01);
    Engine other = scenes::settling_spheres(4, 5, settings);
    other.restore(engine.save());
    EXPECT_GT(other.memory().contacts().size(), 50u);
    scenes::run(engine, 0.5, 0.01);
    scenes::run(other, 0.5, 0.01);
    EXPECT_EQ(engine.save(), other.save());
}

// Periodic in two directions: the same motion as with a shifted start, wherever the sides are.
TEST(SpaceEngine, PeriodicSidesHoldContacts) {
    EngineSettings settings = scenes::exact_in_space(0.3, 1e-12);
    settings.box.length = {4.0, 0.0, 4.0};
    Engine engine(settings, scenes::spheres, {scenes::floor(0.3)});
    engine.bodies().add(scenes::sphere(1, {3.9, 0.5, 3.9}));
    engine.bodies().add(scenes::sphere(2, {0.45, 1.2, 0.45}));
    EXPECT_TRUE(scenes::run(engine, 1.0, 0.01));
    EXPECT_LT(engine.max_penetration(), 1e-6);
    EXPECT_LT(engine.bodies().twist[1].velocity[1], 0.05);
    int touched = 0;
    for (const ContactPoint& point : engine.points()) touched += point.a >= 0;
    EXPECT_LE(touched, 1);
    EXPECT_GT(norm(engine.bodies().twist[0].velocity), 1e-3) << "pushed across the corner";
}

}  // namespace
}  // namespace turbidite::nscd
