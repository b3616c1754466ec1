// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Impacts with restitution: Newton's and Moreau's laws.
#include <gtest/gtest.h>

#include <random>

#include "coupler/rigid/vec3.hpp"
#include "films.hpp"
#include "granular_adapter/nscd/engine/theta_scheme.hpp"

namespace turbidite::nscd {
namespace {

EngineSettings bouncing(double restitution, double friction = 0.0) {
    EngineSettings settings = scenes::exact(friction, 1e-13);
    Surface surface;
    surface.friction = friction;
    surface.restitution = restitution;
    settings.surfaces = {surface};
    return settings;
}

double kinetic_energy(const Bodies& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i)
        sum += 0.5 * b.mass[i] * dot(b.twist[i].velocity, b.twist[i].velocity) +
               0.5 * dot(b.twist[i].spin, b.inertia[i] * b.twist[i].spin);
    return sum;
}

/// Heights of the first bounces of a disc dropped on the floor from a gap of 1.
std::vector<double> bounces(double restitution, double dt, std::size_t count) {
    Engine engine(bouncing(restitution), scenes::discs, {scenes::floor(0.0)});
    engine.bodies().add(scenes::disc(1, 0.0, 1.5));
    std::vector<double> heights;
    double highest = 0.0;
    bool fell = true;
    while (heights.size() < count) {
        engine.step(dt);
        engine.move(dt);
        const bool falls = engine.bodies().twist[0].velocity[1] < 0.0;
        highest = fell && !falls ? 0.0 : std::max(highest, engine.bodies().position[0][1] - 0.5);
        if (falls && !fell) heights.push_back(highest);
        fell = falls;
    }
    return heights;
}

// Height after k bounces: e^2k. A rebound occurs up to one step before the floor, at a gap below n
// dt^2 with n dt = sqrt(2 h). Summed over the steps, each rebound adds at most (1 - e^2) (n + 1)
// dt^2 + (e - e^2) n dt^2/2 to the next height, and an apex between two steps is missed by dt^2/8.
TEST(Restitution, HeightsFallByTheSquareOfRestitution) {
    for (const double e : {0.9, 0.5})
        for (const double dt : {0.01, 0.005, 0.0025}) {
            double height = 1.0, above = 0.0;
            for (const double found : bounces(e, dt, 4)) {
                const double n = std::sqrt(2.0 * (height + above)) / dt;
                above = e * e * above + ((1 - e * e) * (n + 1) + 0.5 * (e - e * e) * n) * dt * dt;
                height *= e * e;
                EXPECT_GE(found, height - dt * dt) << "e " << e << ", dt " << dt;
                EXPECT_LE(found, height + above) << "e " << e << ", dt " << dt;
            }
        }
}

// e = 1 and theta = 1/2 on the discrete heights: n(n + 1)/2 dt^2 is recovered exactly.
TEST(Restitution, FullRestitutionKeepsTheHeight) {
    for (const double height : bounces(1.0, 0.01, 20)) EXPECT_NEAR(height, 1.0, 2e-4);
}

TEST(Restitution, RestingOnAFloorGainsNothing) {
    for (const char* law : {"newton", "moreau"}) {
        EngineSettings settings = bouncing(0.9, 0.3);
        settings.law.impact = law;
        Engine engine(settings, scenes::discs, {scenes::floor(0.3)});
        engine.bodies().add(scenes::disc(1, 0.0, 0.5));
        for (int n = 0; n < 1000; ++n) {
            engine.step(0.01);
            engine.move(0.01);
        }
        EXPECT_NEAR(engine.bodies().position[0][1], 0.5, 1e-15);
        EXPECT_NEAR(kinetic_energy(engine.bodies()), 0.0, 1e-30);
    }
}

/// Velocities of three equal discs in a row after `time`, the first one initially at speed 1.
std::vector<double> chain(double restitution, double gap, double time) {
    EngineSettings settings = bouncing(restitution);
    settings.gravity = {};
    Engine engine(settings, scenes::discs, {});
    for (int k = 0; k < 3; ++k) engine.bodies().add(scenes::disc(k, k * (1.0 + gap), 0.0));
    engine.bodies().twist[0].velocity = {1.0, 0.0, 0.0};
    scenes::run(engine, time, 0.01);
    std::vector<double> speeds;
    for (const Twist& twist : engine.bodies().twist) speeds.push_back(twist.velocity[0]);
    return speeds;
}

// Touching: both contacts act at once, (-1/3, 2/3, 2/3), which is Newton's law and not Newton's
// cradle. With gaps of several steps the collisions follow each other: (0, 0, 1).
TEST(Restitution, ChainOfThreeDiscs) {
    const std::vector<double> all_at_once = chain(1.0, 0.0, 0.01);
    EXPECT_NEAR(all_at_once[0], -1.0 / 3.0, 1e-11);
    EXPECT_NEAR(all_at_once[1], 2.0 / 3.0, 1e-11);
    EXPECT_NEAR(all_at_once[2], 2.0 / 3.0, 1e-11);
    for (const double speed : chain(0.0, 0.0, 0.01)) EXPECT_NEAR(speed, 1.0 / 3.0, 1e-11);
    const std::vector<double> one_by_one = chain(1.0, 0.05, 0.5);
    EXPECT_NEAR(one_by_one[0], 0.0, 1e-12);
    EXPECT_NEAR(one_by_one[1], 0.0, 1e-12);
    EXPECT_NEAR(one_by_one[2], 1.0, 1e-12);
}

// e = e_t = 1 under high friction: both components of the contact velocity are reversed, and no
// energy is lost. Moreau's law with e = 1 does the same.
TEST(Restitution, SuperballReversesItsSlip) {
    for (const char* law : {"newton", "moreau"}) {
        EngineSettings settings = bouncing(1.0, 10.0);
        settings.gravity = {};
        settings.law.impact = law;
        if (settings.law.impact == "newton") settings.surfaces[0].restitution_tangential = 1.0;
        Engine engine(settings, scenes::discs, {scenes::floor(10.0)});
        engine.bodies().add(scenes::disc(1, 0.0, 0.5));
        engine.bodies().twist[0] = {{0.5, -1.0, 0.0}, {0.0, 0.0, 3.0}};
        const double before = kinetic_energy(engine.bodies());
        engine.step(0.01);
        const Twist& after = engine.bodies().twist[0];
        EXPECT_NEAR(after.velocity[1], 1.0, 1e-12);
        // Initially 0.5 + R spin = 2.
        EXPECT_NEAR(after.velocity[0] + 0.5 * after.spin[2], -2.0, 1e-12);
        EXPECT_NEAR(kinetic_energy(engine.bodies()), before, 1e-12);
    }
}

// The slip is turned back once, whatever the gap at the start and whether there is a rebound: none
// without normal restitution, or where a film takes all of it.
TEST(Restitution, TurnsTheSlipBackOnce) {
    const auto slip_after = [](EngineSettings settings, double gap) {
        settings.gravity = {};
        Engine engine(settings, scenes::discs, {scenes::floor(10.0)});
        engine.bodies().add(scenes::disc(1, 0.0, 0.5 + gap));
        engine.bodies().rotation_blocked[0] = 1;
        engine.bodies().twist[0].velocity = {1.0, -1.0, 0.0};
        scenes::run(engine, 0.2, 0.01);
        return engine.bodies().twist[0].velocity[0];
    };
    for (const double gap : {0.0, 0.002, 0.005, 0.008, 0.0099})
        for (const double restitution : {0.0, 0.001, 0.5}) {
            EngineSettings settings = bouncing(restitution, 10.0);
            settings.surfaces[0].restitution_tangential = 0.5;
            EXPECT_NEAR(slip_after(settings, gap), -0.5, 1e-12) << gap << " " << restitution;
        }
    for (const char* law : {"newton", "moreau"}) {
        EngineSettings settings = scenes::with_film(bouncing(0.3, 10.0), 0.0016);
        settings.law.impact = law;
        if (settings.law.impact == "newton") settings.surfaces[0].restitution_tangential = 0.3;
        EXPECT_NEAR(slip_after(settings, 0.005), -0.3, 1e-9) << law;
    }
}

// Approach slower than the threshold: no rebound.
TEST(Restitution, SlowApproachesDoNotBounce) {
    EngineSettings settings = bouncing(0.8);
    settings.gravity = {};
    settings.law_settings.restitution_speed = 0.1;
    for (const double speed : {0.099, 0.101}) {
        Engine engine(settings, scenes::discs, {scenes::floor(0.0)});
        engine.bodies().add(scenes::disc(1, 0.0, 0.5));
        engine.bodies().twist[0].velocity = {0.0, -speed, 0.0};
        engine.step(0.01);
        EXPECT_NEAR(engine.bodies().twist[0].velocity[1], speed > 0.1 ? 0.8 * speed : 0.0, 1e-13);
    }
}

/// 100 discs with random velocities in a periodic box.
Engine gas(const EngineSettings& base, double spacing = 1.2) {
    EngineSettings settings = base;
    settings.gravity = {};
    settings.law_settings.recovery_fraction = 0.0;
    settings.box.length = {10.0 * spacing, 10.0 * spacing, 0.0};
    Engine engine(settings, scenes::discs, {});
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int k = 0; k < 100; ++k) {
        Body body = scenes::disc(k, (k % 10 + 0.5) * spacing, (k / 10 + 0.5) * spacing);
        body.twist = {{any(random), any(random), 0.0}, {0.0, 0.0, 2.0 * any(random)}};
        engine.bodies().add(body);
    }
    return engine;
}

// Moreau's law with any friction; Newton's without friction (with friction it may gain energy if
// several contacts of a body act at once: 2e-4 in one step of this gas with mu = 0.4 and e = 1).
TEST(Restitution, GasNeverGainsEnergy) {
    const std::pair<const char*, double> laws[] = {
        {"newton", 0.0}, {"moreau", 0.0}, {"moreau", 0.3}};
    for (const auto& [law, rolling] : laws)
        for (const double e : {0.5, 1.0}) {
            EngineSettings settings = bouncing(e, std::string(law) == "moreau" ? 0.4 : 0.0);
            settings.law.impact = law;
            settings.surfaces[0].rolling_friction = rolling;
            Engine engine = gas(settings);
            const double start = kinetic_energy(engine.bodies());
            double before = start;
            for (int n = 0; n < 150; ++n) {
                engine.step(0.01);
                const double now = kinetic_energy(engine.bodies());
                EXPECT_LE(now, before * (1 + 1e-12)) << law << " e " << e << " step " << n;
                before = now;
                engine.move(0.01);
            }
            EXPECT_LT(before, 0.999 * start) << "they must have met";
            EXPECT_LT(engine.max_penetration(), 1e-6);
        }
}

/// A disc between two walls that leave it a hundredth of its diameter on each side.
Engine in_a_slit(const EngineSettings& settings) {
    Engine engine(settings, scenes::discs,
                  {scenes::floor(settings.friction),
                   scenes::wall(2, {0, 1.02, 0}, {0, -1, 0}, settings.friction)});
    Body disc = scenes::disc(1, 0.0, 0.51);
    disc.twist.velocity = {3.0, 2.0, 0.0};
    engine.bodies().add(disc);
    return engine;
}

// In a step of 0.0125 it would go 0.025 up. Thrown back at 1 it would go 0.0125 down, which is more
// than the gap behind it: both walls would push without end, and friction with them.
TEST(Restitution, WhatIsThrownBackFindsRoomBehind) {
    for (const char* law : {"newton", "moreau"}) {
        EngineSettings settings = bouncing(0.5, 0.3);
        settings.gravity = {};
        settings.law.impact = law;
        Engine engine = in_a_slit(settings);
        EXPECT_TRUE(engine.step(0.0125).converged);
        const Vec3 once = engine.bodies().twist[0].velocity;
        EXPECT_NEAR(once[1], -1.0, 1e-12) << law;
        // mu (1 + e) |u_n| is lost by sliding; Moreau's law takes it likewise.
        EXPECT_NEAR(once[0], 3.0 - 0.3 * 1.5 * 2.0, 1e-12) << law;
        engine.move(0.0125);
        EXPECT_GT(engine.max_penetration(), 0.0) << "the room is less than the rebound takes";
        EXPECT_LT(engine.max_penetration(), 0.0125 - 0.01 + 1e-12);
        engine.step(0.0125);
        EXPECT_NEAR(engine.bodies().twist[0].velocity[1], 0.5, 1e-9) << law << ": the next impact";
    }
}

// A light disc that moves up to a heavy one and down from the floor: the heavy one got 400 times
// the energy that there was.
TEST(Restitution, AHeavyNeighbourGetsNoMoreThanThereWas) {
    for (const char* law : {"newton", "moreau"})
        for (const double radius : {1.0, 5.0}) {
            EngineSettings settings = bouncing(0.9);
            settings.gravity = {};
            settings.law.impact = law;
            Engine engine(settings, scenes::discs, {scenes::floor(0.0)});
            Body light = scenes::disc(1, 0.0, 0.505);
            light.twist.velocity = {0.0, 2.0, 0.0};
            engine.bodies().add(light);
            engine.bodies().add(scenes::disc(2, 0.0, 1.01 + radius, radius));
            double before = kinetic_energy(engine.bodies());
            const double start = before;
            for (int n = 0; n < 20; ++n) {
                EXPECT_TRUE(engine.step(0.0125).converged);
                const double now = kinetic_energy(engine.bodies());
                EXPECT_LE(now, before * (1 + 1e-9)) << law << ", radius " << radius << ", " << n;
                before = now;
                engine.move(0.0125);
            }
            EXPECT_LT(before, 0.95 * start) << "they must have met";
        }
}

// The gas as a crowd: gaps of 0.002, of which a grain crosses ten in a step.
TEST(Restitution, ACrowdNeverGainsEnergy) {
    const std::pair<const char*, double> laws[] = {
        {"newton", 0.0}, {"moreau", 0.0}, {"moreau", 0.3}};
    for (const auto& [law, friction] : laws)
        for (const double e : {0.5, 0.9, 1.0}) {
            EngineSettings settings = bouncing(e, friction);
            settings.law.impact = law;
            Engine engine = gas(settings, 1.002);
            const double start = kinetic_energy(engine.bodies());
            double most = start;
            for (int n = 0; n < 20; ++n) {
                engine.step(0.0125);
                most = std::max(most, kinetic_energy(engine.bodies()));
                engine.move(0.0125);
            }
            EXPECT_LE(most, start * (1 + 1e-9)) << law << ", friction " << friction << ", e " << e;
            EXPECT_LT(kinetic_energy(engine.bodies()), 0.99 * start) << "they must have met";
        }
}

// theta = 1/2: the sum of kinetic and potential energy, the latter at x (Eq. 17), changes by the
// work of the contact impulses, r . (u^k + u^{k+1})/2, and by nothing else.
TEST(Restitution, EnergyChangesByTheWorkOfImpulses) {
    const double dt = 0.01;
    Engine engine = scenes::settling_pack(6, 6, bouncing(0.5, 0.3));
    const auto energy = [&] {
        double sum = kinetic_energy(engine.bodies());
        const Bodies& b = engine.bodies();
        for (std::size_t i = 0; i < b.size(); ++i)
            sum += b.weight_mass[i] *
                   end_configuration(b.position[i], b.twist[i].velocity, dt, 0.5)[1];
        return sum;
    };
    double expected = energy();
    double work = 0.0;
    for (int n = 0; n < 150; ++n) {
        const std::vector<Twist> before = engine.bodies().twist;
        engine.step(dt);
        for (std::size_t k = 0; k < engine.points().size(); ++k) {
            const Contact& contact = engine.problem().contacts[k];
            const ContactVector old = contact_velocity(contact, before);
            const ContactVector now = contact_velocity(contact, engine.bodies().twist);
            work += 0.5 * dot(engine.impulses()[k], old + now);
        }
        engine.move(dt);
    }
    EXPECT_NEAR(energy(), expected + work, 1e-11 * expected);
    EXPECT_LT(work, -0.1 * expected) << "there must be impacts, or this tests nothing";
}

TEST(Restitution, RefusesWhatWouldCreateEnergy) {
    EngineSettings settings = bouncing(0.5);
    settings.theta = 1.0 / 1.5;
    EXPECT_NO_THROW(Engine(settings, scenes::discs, {}));
    settings.theta = 0.67;
    EXPECT_THROW(Engine(settings, scenes::discs, {}), std::invalid_argument);
    settings.theta = 0.5;
    settings.surfaces[0].restitution = 1.0;
    EXPECT_NO_THROW(Engine(settings, scenes::discs, {}));
    settings.surfaces[0].restitution = 1.1;
    EXPECT_THROW(Engine(settings, scenes::discs, {}), std::invalid_argument);
    settings.surfaces[0].restitution = -0.1;
    EXPECT_THROW(Engine(settings, scenes::discs, {}), std::invalid_argument);
}

TEST(Restitution, MoreauHasNoTangentialOne) {
    EngineSettings settings = bouncing(0.5);
    settings.law.impact = "moreau";
    settings.surfaces[0].restitution_tangential = 0.2;
    EXPECT_THROW(Engine(settings, scenes::discs, {}), std::invalid_argument);
}

}  // namespace
}  // namespace turbidite::nscd
