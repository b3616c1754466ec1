// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What stands and what does not: spheres at rest by friction alone.
#include <gtest/gtest.h>

#include "spheres.hpp"

namespace turbidite::nscd {
namespace {

constexpr double mu_ample = 0.6;

/// A sphere on three that touch each other on a floor: a tetrahedron of unit edge.
Engine pyramid(double between_spheres, double on_floor) {
    EngineSettings settings = scenes::exact_in_space(between_spheres, 1e-11);
    Engine engine(settings, scenes::spheres, {scenes::floor(on_floor)});
    const double out = 1.0 / std::sqrt(3.0);
    for (int i = 0; i < 3; ++i) {
        const double angle = 0.2 + 2.0 * std::numbers::pi / 3.0 * i;
        engine.bodies().add(
            scenes::sphere(i + 1, {out * std::cos(angle), 0.5, out * std::sin(angle)}));
    }
    engine.bodies().add(scenes::sphere(4, {0.0, 0.5 + std::sqrt(2.0 / 3.0), 0.0}));
    return engine;
}

/// Speed of the upper sphere after a while.
double fall(Engine engine) {
    EXPECT_TRUE(scenes::run(engine, 1.0, 0.01));
    return norm(engine.bodies().twist[3].velocity);
}

// A base sphere touches at two points, the floor and the upper sphere, and its own weight acts at
// the first line: without a moment about the floor's point the upper force is along the line
// through both points, at half of the angle theta between vertical and normal, sin theta =
// 1/sqrt(3). So mu >= tan(theta/2) = 0.3178 between spheres; on the floor it carries a third of the
// upper weight and its own: mu >= tan(theta/2)/4 = 0.0795.
TEST(SpaceStatics, ASphereOnThreeStandsIffFrictionHoldsIt) {
    const double half = std::tan(0.5 * std::asin(1.0 / std::sqrt(3.0)));
    EXPECT_NEAR(half, 0.3178, 1e-4);
    EXPECT_LT(fall(pyramid(half + 1e-3, mu_ample)), 1e-8);
    EXPECT_GT(fall(pyramid(half - 1e-3, mu_ample)), 1e-4);
    EXPECT_LT(fall(pyramid(mu_ample, 0.25 * half + 5e-4)), 1e-8);
    EXPECT_GT(fall(pyramid(mu_ample, 0.25 * half - 5e-4)), 1e-4);
}

// With momentum between sweeps.
TEST(SpaceStatics, ATallStackFeelsItsWeightInSomeHundredSweeps) {
    constexpr int count = 60;
    Engine engine(scenes::exact_in_space(mu_ample, 1e-6), scenes::spheres,
                  {scenes::floor(mu_ample)});
    for (int i = 0; i < count; ++i) engine.bodies().add(scenes::sphere(i + 1, {0.0, i + 0.5, 0.0}));
    const StepReport report = engine.step(0.01);
    EXPECT_TRUE(report.converged);
    EXPECT_LT(report.iterations, 1000);
    double lowest = 0.0;
    for (const ContactVector& r : engine.impulses()) lowest = std::max(lowest, r.n);
    EXPECT_NEAR(lowest / (count * 0.01 * engine.bodies().mass[0]), 1.0, 0.01);
}

// In a pocket of fixed spheres no friction is needed: three normals carry the weight, each m g/(3
// cos theta).
TEST(SpaceStatics, APocketOfFixedSpheresNeedsNoFriction) {
    Engine engine = pyramid(0.0, 0.0);
    for (std::size_t i = 0; i < 3; ++i) engine.bodies().fixed[i] = 1;
    EXPECT_TRUE(scenes::run(engine, 0.5, 0.01));
    EXPECT_LT(norm(engine.bodies().twist[3].velocity), 1e-12);
    const double weight = engine.bodies().mass[3], cosine = std::sqrt(2.0 / 3.0);
    int carrying = 0;
    for (const ContactVector& r : engine.impulses())
        if (r.n > 0.0) {
            EXPECT_NEAR(r.n / 0.01, weight / (3.0 * cosine), 1e-10);
            ++carrying;
        }
    EXPECT_EQ(carrying, 3);
}

/// Deepest overlap within a second of a sphere of radius 1 on one of `small`, over that radius, at
/// the usual tolerance; and whether all steps converged.
std::pair<double, bool> heavy_on_light(double small) {
    Engine engine(scenes::exact_in_space(0.3, 1e-3), scenes::spheres, {scenes::floor(0.3)});
    engine.bodies().add(scenes::sphere(1, {0.0, small, 0.0}, small));
    engine.bodies().add(scenes::sphere(2, {0.0, 2.0 * small + 1.01, 0.0}, 1.0));
    double deepest = 0.0;
    bool converged = true;
    for (int i = 0; i < 100; ++i) {
        converged = engine.step(0.01).converged && converged;
        engine.move(0.01);
        deepest = std::max(deepest, engine.max_penetration());
    }
    EXPECT_EQ(engine.points().size(), 2u);
    return {deepest / small, converged};
}

// A contact of the light one weighs next to nothing in the residual, which is met while it is
// pressed through: with the residual alone by its whole diameter.
TEST(SpaceStatics, ALightSphereUnderAHeavyOneIsNotPressedThrough) {
    for (const double small : {0.2, 0.1, 0.05}) {
        const auto [deepest, converged] = heavy_on_light(small);
        EXPECT_TRUE(converged) << small;
        EXPECT_LT(deepest, 0.05) << small;
    }
}

// The heavy sphere comes down on a small one beside its lowest point, which must leave at cot(a) =
// 10 times its speed, n = (sin a, cos a): farther within the step than any motion before had
// foretold, and there another one lies.
TEST(SpaceStatics, ASphereThatIsSqueezedOutDoesNotGoThroughTheNext) {
    constexpr double small = 0.1, step = 0.01, sine = 0.1, gap = 0.05;
    Engine engine(scenes::exact_in_space(0.0), scenes::spheres, {scenes::floor(0.0)});
    engine.bodies().add(scenes::sphere(1, {0.0, small, 0.0}, small));
    const Vec3 to_heavy{sine, std::sqrt(1.0 - sine * sine), 0.0};
    engine.bodies().add(scenes::sphere(2, Vec3{0.0, small, 0.0} + (1.0 + small) * to_heavy, 1.0));
    engine.bodies().add(scenes::sphere(3, {-2.0 * small - gap, small, 0.0}, small));
    engine.bodies().twist[1].velocity = {0.0, -1.0, 0.0};
    EXPECT_TRUE(engine.step(step).converged);
    engine.move(step);
    EXPECT_LT(engine.bodies().position[0][0], -gap);
    EXPECT_LT(engine.bodies().twist[2].velocity[0], -1.0);
    EXPECT_LT(engine.max_penetration(), 0.01 * small);
}

// Of many like spheres one may sink in, whose error the residual of all hides: it gets more sweeps.
// Of an overlap a part is left in the steps after it, so that several make more than one does.
TEST(SpaceStatics, NoSphereOfManySinksInFar) {
    Engine engine = scenes::settling_spheres(6, 9, scenes::exact_in_space(0.4, 1e-2));
    double deepest = 0.0, fastest = 0.0;
    for (int n = 0; n < 300; ++n) {
        ASSERT_TRUE(engine.step(0.04).converged) << n;
        engine.move(0.04);
        deepest = std::max(deepest, engine.max_penetration());
        fastest = std::max(fastest, scenes::kinetic_energy(engine.bodies()));
    }
    EXPECT_GT(fastest, 10.0) << "it fell";
    EXPECT_LT(deepest, 1.5e-3) << "2.4e-3 without";
}

// A column of spheres on the floor carries itself: contact k from the top has k weights.
TEST(SpaceStatics, AColumnCarriesItsWeight) {
    Engine engine(scenes::exact_in_space(0.3, 1e-12), scenes::spheres, {scenes::floor(0.3)});
    for (int i = 0; i < 5; ++i) engine.bodies().add(scenes::sphere(i + 1, {0.0, 0.5 + i, 0.0}));
    EXPECT_TRUE(scenes::run(engine, 0.2, 0.01));
    for (std::size_t k = 0; k < engine.points().size(); ++k) {
        const double above = 4.0 - engine.points()[k].b + 1.0;
        EXPECT_NEAR(engine.impulses()[k].n / 0.01, above * engine.bodies().mass[0], 1e-9);
    }
    EXPECT_EQ(engine.points().size(), 5u);
}

std::vector<double> sorted_speeds(const Bodies& bodies) {
    std::vector<double> speeds;
    for (const Twist& twist : bodies.twist) speeds.push_back(norm(twist.velocity));
    std::sort(speeds.begin(), speeds.end());
    return speeds;
}

// A few hundred spheres fall into a box and come to rest, apart from a few that roll about on the
// surface, which nothing slows down; every step is solved.
TEST(SpaceStatics, APackingComesToRest) {
    Engine engine = scenes::settling_spheres(6, 9, scenes::exact_in_space(0.4, 1e-3));
    ASSERT_EQ(engine.bodies().size(), 324u);
    const double start = scenes::kinetic_energy(engine.bodies());
    EXPECT_EQ(start, 0.0);
    double fastest = 0.0, deepest = 0.0;
    for (int n = 0; n < 1250; ++n) {
        const StepReport report = engine.step(0.01);
        ASSERT_TRUE(report.converged) << n << " " << report.residual;
        ASSERT_LE(report.residual, 1e-3);
        engine.move(0.01);
        fastest = std::max(fastest, scenes::kinetic_energy(engine.bodies()));
        deepest = std::max(deepest, report.max_penetration);
    }
    EXPECT_GT(fastest, 10.0) << "it fell";
    const std::vector<double> speeds = sorted_speeds(engine.bodies());
    EXPECT_LT(speeds[speeds.size() / 2], 5e-4) << "a twentieth of g dt";
    EXPECT_LT(speeds[speeds.size() * 9 / 10], 5e-3) << "half of g dt";
    EXPECT_LT(scenes::kinetic_energy(engine.bodies()), 5e-3 * fastest) << "of those that roll";
    EXPECT_LT(deepest, 1e-3);
    double pressed = 0.0, weight = 0.0;
    for (std::size_t k = 0; k < engine.points().size(); ++k) {
        const ContactPoint& point = engine.points()[k];
        if (point.wall >= 0)
            pressed += world_impulse(engine.problem().contacts[k], engine.impulses()[k])[1];
    }
    for (const double mass : engine.bodies().mass) weight += mass;
    EXPECT_NEAR(pressed / 0.01, weight, 0.01 * weight) << "the walls carry it";
}

}  // namespace
}  // namespace turbidite::nscd
