// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Engines that share a configuration in space have the bits of one engine that has all of it.
#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <set>

#include "memory_exchange.hpp"
#include "spheres.hpp"

namespace turbidite::nscd {
namespace {

struct Scene {
    EngineSettings settings;
    std::vector<Wall> walls;
    Bodies bodies;
    int steps = 60;
    double dt = 0.01;
};

/// What is compared.
struct Played {
    struct Grain {
        Vec3 position{};
        Quaternion orientation{};
        Twist twist;
        Vec3 impulse{}, angular_impulse{};
        friend bool operator==(const Grain& a, const Grain& b) {
            return a.position == b.position && a.orientation == b.orientation &&
                   a.twist == b.twist && a.impulse == b.impulse &&
                   a.angular_impulse == b.angular_impulse;
        }
    };
    std::map<GrainId, Grain> grains;
    std::map<ContactKey, std::pair<ContactVector, Vec3>> impulses;
    std::map<ContactKey, ContactVector> memory;
    std::map<ContactKey, ContactState> states;
    std::vector<std::int64_t> iterations;
    std::vector<double> residuals, quads, overlaps, violations;
    std::int64_t contacts = 0;

    // Of the way it was played.
    std::set<GrainId> moved;  ///< bodies that have changed their rank
    std::size_t doubles = 0;  ///< sent in phases
    std::size_t empty_ranks = 0;
};

ContactKey key_of(const Engine& engine, const ContactPoint& point) {
    const std::vector<GrainId>& id = engine.bodies_of_points().id;
    if (point.wall >= 0) return {engine.walls()[point.wall].key, id[point.b], 1, point.feature};
    return {id[point.a], id[point.b], 0, point.feature};
}

void add_result(const Engine& engine, Played& result) {
    const Bodies& bodies = engine.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i)
        EXPECT_TRUE(
            result.grains
                .emplace(bodies.id[i], Played::Grain{bodies.position[i], bodies.orientation[i],
                                                     bodies.twist[i], bodies.contact_impulse[i],
                                                     bodies.contact_angular_impulse[i]})
                .second);
    for (std::size_t k = 0; k < engine.points().size(); ++k)
        EXPECT_TRUE(
            result.impulses
                .emplace(key_of(engine, engine.points()[k]),
                         std::pair(engine.impulses()[k], world_moment(engine.impulses(), k)))
                .second);
    for (const RememberedContact& contact : engine.memory().contacts())
        EXPECT_TRUE(result.memory.emplace(contact.key, contact.force).second);
}

Played play(const Scene& scene, int ranks) {
    Played result;
    std::mutex mutex;
    std::map<GrainId, int> home;
    on_ranks(ranks, [&](MemoryExchange& exchange) {
        Engine engine(scene.settings, scenes::spheres, scene.walls);
        engine.bodies() = scene.bodies;
        std::vector<std::uint8_t> mine;
        for (std::size_t i = 0; i < scene.bodies.size(); ++i)
            mine.push_back(static_cast<int>(i) % ranks == exchange.rank());
        if (ranks > 1) engine.bodies().keep(mine), engine.share_with(exchange);
        std::vector<double> overlaps, violations;
        engine.max_penetration();
        for (int step = 0; step < scene.steps; ++step) {
            const StepReport report = engine.step(scene.dt);
            violations.push_back(engine.contact_violation());
            {
                const std::lock_guard lock(mutex);
                for (const GrainId id : engine.bodies().id) {
                    const auto [at, is_new] = home.emplace(id, exchange.rank());
                    if (at->second != exchange.rank()) result.moved.insert(id);
                    at->second = exchange.rank();
                }
                result.contacts += report.contacts;
                if (exchange.rank() == 0) {
                    result.iterations.push_back(report.iterations);
                    result.residuals.push_back(report.residual);
                    result.quads.push_back(report.change.quad);
                }
            }
            if (step + 1 < scene.steps) engine.move(scene.dt);
            if (step + 1 < scene.steps) overlaps.push_back(engine.max_penetration_after_move());
        }
        const std::lock_guard lock(mutex);
        add_result(engine, result);
        for (auto [all, own] :
             {std::pair{&result.overlaps, &overlaps}, std::pair{&result.violations, &violations}}) {
            all->resize(own->size());
            for (std::size_t i = 0; i < own->size(); ++i)
                (*all)[i] = std::max((*all)[i], (*own)[i]);
        }
        result.doubles += exchange.moved();
        result.empty_ranks += engine.bodies().size() == 0;
    });
    return result;
}

void expect_equal(const Played& one, const Played& many) {
    EXPECT_EQ(one.iterations, many.iterations);
    EXPECT_EQ(one.residuals, many.residuals);
    EXPECT_EQ(one.quads, many.quads);
    EXPECT_EQ(one.overlaps, many.overlaps);
    EXPECT_EQ(one.violations, many.violations);
    EXPECT_EQ(one.contacts, many.contacts);
    EXPECT_TRUE(one.grains == many.grains);
    EXPECT_TRUE(one.impulses == many.impulses);
    EXPECT_TRUE(one.memory == many.memory);
}

/// Spheres that slide along x over the floor of a box, in a heap.
Scene slide(int columns = 12, int rows = 4) {
    Scene scene;
    scene.settings = scenes::exact_in_space(0.4, 1e-4);
    Engine engine = scenes::settling_spheres(columns, rows, scene.settings);
    scene.bodies = engine.bodies();
    scene.walls = {scenes::floor(0.4)};
    for (Twist& twist : scene.bodies.twist) twist.velocity = {2.0, -1.0, 0.7};
    return scene;
}

TEST(Ranks, HaveTheBitsOfOneRank) {
    const Scene scene = slide();
    const Played one = play(scene, 1);
    ASSERT_GT(one.contacts, 5000);
    for (const int ranks : {2, 3, 4}) {
        const Played many = play(scene, ranks);
        expect_equal(one, many);
        EXPECT_GT(many.moved.size(), 10u) << "bodies have to change their rank";
        EXPECT_GT(many.doubles, 3000u);
        EXPECT_EQ(many.empty_ranks, 0u);
    }
}

TEST(Ranks, HaveTheBitsOfOneRankWithFilms) {
    Scene scene = slide(9, 3);
    scene.settings.law.film = "lubrication";
    scene.settings.law_settings.viscosity = 0.01;
    scene.settings.law_settings.film_cutoff = 0.1;
    scene.settings.law_settings.film_roughness = 0.001;
    const Played one = play(scene, 1);
    ASSERT_GT(one.contacts, 500);
    EXPECT_GT(std::count_if(one.impulses.begin(), one.impulses.end(),
                            [](const auto& entry) { return entry.second.first.n < 0.0; }),
              20)
        << "films that part";
    for (const int ranks : {2, 3}) {
        const Played many = play(scene, ranks);
        expect_equal(one, many);
        EXPECT_GT(many.moved.size(), 10u);
    }
}

TEST(Ranks, HaveTheBitsOfOneRankInAPeriodicBox) {
    Scene scene = slide(14, 3);
    scene.settings.box.length = {15.4, 0.0, 15.4};
    scene.settings.box.lower = {0.0, 0.0, 0.0};
    for (Twist& twist : scene.bodies.twist) twist.velocity = {5.0, -1.0, 4.0};
    const Played one = play(scene, 1);
    ASSERT_GT(one.contacts, 5000);
    for (const int ranks : {2, 4}) {
        const Played many = play(scene, ranks);
        expect_equal(one, many);
        EXPECT_GT(many.moved.size(), 50u);
    }
}

TEST(Ranks, HaveTheBitsOfOneRankWithLargeAndFixedBodies) {
    Scene scene = slide(12, 4);
    scene.bodies.fixed[100] = 1;
    scene.bodies.twist[100] = {};
    for (const double x : {3.0, 10.0}) {
        Body large = scenes::sphere(static_cast<GrainId>(5000 + x), {x, 8.0, 6.0}, 2.5);
        large.twist.velocity = {0.0, -4.0, 0.0};
        scene.bodies.add(large);
    }
    const Played one = play(scene, 1);
    const auto of_large = std::count_if(
        one.impulses.begin(), one.impulses.end(),
        [](const auto& x) { return x.first.second >= 5000 && x.second.first.n > 0.0; });
    ASSERT_GT(of_large, 3);
    for (const int ranks : {2, 3}) expect_equal(one, play(scene, ranks));
}

TEST(Ranks, HaveTheBitsOfOneRankWithEveryLaw) {
    Scene scene = slide(10, 4);
    Surface surface;
    surface.friction = 0.3;
    surface.static_friction = 0.5;
    surface.restitution = 0.4;
    surface.restitution_tangential = 0.2;
    surface.rolling_friction = 0.1;
    surface.torsion_friction = 0.1;
    surface.adhesion = 0.5;
    scene.settings.surfaces = {surface};
    scene.settings.law.friction = "static-dynamic";
    scene.settings.law.adhesion = "cohesion";
    scene.settings.law_settings.adhesion_range = 0.01;
    scene.settings.law_settings.adhesion_shear = 1.0;
    for (Wall& wall : scene.walls) wall.material = 0;
    const Played one = play(scene, 1);
    ASSERT_GT(one.contacts, 2000);
    const auto turning = std::count_if(one.impulses.begin(), one.impulses.end(),
                                       [](const auto& x) { return norm(x.second.second) > 0.0; });
    ASSERT_GT(turning, 20);
    for (const int ranks : {2, 3}) {
        const Played many = play(scene, ranks);
        expect_equal(one, many);
        EXPECT_GT(many.moved.size(), 5u);
    }
}

// A heap that rests, and as many spheres that fall far from each other: first half of the bodies
// each, then half of the contacts.
TEST(Ranks, AreCutAnewWhereTheWorkIsUneven) {
    Scene scene;
    scene.settings = scenes::exact_in_space(0.4, 1e-4);
    scene.walls = {scenes::floor(0.4)};
    scene.steps = 30;
    GrainId id = 0;
    for (int x = 0; x < 12; ++x)
        for (int z = 0; z < 6; ++z)
            for (int y = 0; y < 3; ++y)
                scene.bodies.add(scenes::sphere(++id, {0.5 + x, 0.5 + y, 0.5 + z}));
    const GrainId of_heap = id;
    for (int i = 0; i < of_heap; ++i)
        scene.bodies.add(scenes::sphere(++id, {30.0 + 2.0 * (i % 20), 50.0, 2.0 * (i / 20)}));
    const Played one = play(scene, 1), many = play(scene, 2);
    expect_equal(one, many);
    ASSERT_GT(one.contacts, 1000);
    const auto moved = std::count_if(many.moved.begin(), many.moved.end(),
                                     [of_heap](GrainId moved) { return moved <= of_heap; });
    EXPECT_GT(moved, 50);
}

// One rank has nothing.
TEST(Ranks, MayBeEmpty) {
    Scene scene;
    scene.settings = scenes::exact_in_space(0.4);
    scene.walls = {scenes::floor(0.4)};
    for (int i = 0; i < 3; ++i)
        scene.bodies.add(scenes::sphere(i + 1, {0.3 * i, 0.5 + 1.0 * i, 0}));
    const Played one = play(scene, 1), many = play(scene, 3);
    expect_equal(one, many);
    EXPECT_GE(many.empty_ranks, 1u);
    EXPECT_GT(one.contacts, 100);
}

TEST(Ranks, AreRefusedInThePlane) {
    on_ranks(2, [](MemoryExchange& exchange) {
        Engine engine(scenes::exact(0.3), scenes::discs, {});
        EXPECT_THROW(engine.share_with(exchange), std::invalid_argument);
    });
}

}  // namespace
}  // namespace turbidite::nscd
