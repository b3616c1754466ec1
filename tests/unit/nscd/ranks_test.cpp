// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Engines that share a configuration in space have the bits of one engine that has all of it.
#include "rank_scenes.hpp"

namespace turbidite::nscd {
namespace {

using scenes::expect_equal, scenes::play, scenes::Played, scenes::Scene;

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

// The step in which a heavy sphere squeezes a small one out at ten times its own speed, towards
// another one, is solved again with a longer search: other cells, other owners and copies.
TEST(Ranks, HaveTheBitsOfOneRankWhereASphereIsSqueezedOut) {
    Scene scene = slide(8, 3);
    constexpr double small = 0.1, sine = 0.1, gap = 0.05;
    const Vec3 place{-4.0, small, 6.0};
    const Vec3 to_heavy{sine, std::sqrt(1.0 - sine * sine), 0.0};
    scene.bodies.add(scenes::sphere(5000, place, small));
    Body heavy = scenes::sphere(5001, place + (1.0 + small) * to_heavy, 1.0);
    heavy.twist.velocity = {0.0, -2.0, 0.0};
    scene.bodies.add(heavy);
    scene.bodies.add(scenes::sphere(5002, place - Vec3{2.0 * small + gap, 0.0, 0.0}, small));
    scene.walls = {scenes::floor(0.0)};
    scene.settings.surfaces = {Surface{}};
    scene.steps = 3;
    const Played one = play(scene, 1);
    ASSERT_LT(one.grains.at(5002).twist.velocity[0], -4.0);
    for (const int ranks : {2, 3, 4}) expect_equal(one, play(scene, ranks));
}

/// Ten small and ten large spheres along x, apart from each other but for a pair at the far end,
/// which is bonded and pulled apart: the one with the lower id is small or large.
Scene bonded_pair(bool small_first) {
    Scene scene;
    scene.settings = scenes::exact_in_space(0.4);
    scene.settings.gravity = {};
    Surface surface;
    surface.friction = 0.4;
    surface.adhesion = 50.0;
    scene.settings.surfaces = {surface};
    scene.settings.law.adhesion = "cohesion";
    scene.settings.law_settings.adhesion_range = 0.01;
    scene.settings.law_settings.adhesion_shear = 1.0;
    for (int i = 0; i < 9; ++i) {
        scene.bodies.add(scenes::sphere(10 + i, {2.0 * i, 0.0, 0.0}));
        scene.bodies.add(scenes::sphere(30 + i, {6.0 * i, 20.0, 0.0}, 2.5));
    }
    scene.bodies.add(scenes::sphere(small_first ? 50 : 51, {80.0, 0.0, 0.0}));
    Body large = scenes::sphere(small_first ? 51 : 50, {83.0, 0.0, 0.0}, 2.5);
    large.twist.velocity = {0.01, 0.0, 0.0};
    scene.bodies.add(large);
    scene.steps = 8;
    return scene;
}

double end_velocity(const Played& played, GrainId id) {
    return played.grains.at(id).twist.velocity[0];
}

// As many small ones as large ones: none is large by the median until one has left. Then their
// contacts are of the first rank, and so is what is known of them.
TEST(Ranks, ABondStaysWhereABodyBecomesLarge) {
    for (const bool small_first : {true, false}) {
        Scene scene = bonded_pair(small_first);
        scene.leavers = {30};
        const Played one = play(scene, 1);
        EXPECT_GT(end_velocity(one, small_first ? 50 : 51), 0.005) << "the bond pulls it along";
        for (const int ranks : {2, 3}) expect_equal(one, play(scene, ranks));
    }
}

TEST(Ranks, ABondStaysWhereALargeBodyBecomesOneOfMany) {
    for (const bool small_first : {true, false}) {
        Scene scene = bonded_pair(small_first);
        // One more small one, which leaves: large ones are large until then.
        scene.bodies.add(scenes::sphere(60, {40.0, 0.0, 0.0}));
        scene.leavers = {60};
        const Played one = play(scene, 1);
        EXPECT_GT(end_velocity(one, small_first ? 50 : 51), 0.005) << "the bond pulls it along";
        for (const int ranks : {2, 3}) expect_equal(one, play(scene, ranks));
    }
}

/// Every `ranks`-th body from the one with the number of the rank on.
void keep_share(Engine& engine, const MemoryExchange& exchange, int ranks) {
    std::vector<std::uint8_t> mine;
    for (std::size_t i = 0; i < engine.bodies().size(); ++i)
        mine.push_back(static_cast<int>(i) % ranks == exchange.rank());
    engine.keep(mine);
}

/// The velocity of a body four steps after it was restored, in engines that have begun anew before.
double velocity_after_restart(const Scene& scene, const std::vector<char>& saved, GrainId id,
                              int ranks) {
    double result = 0.0;
    std::mutex mutex;
    on_ranks(ranks, [&](MemoryExchange& exchange) {
        Engine engine(scene.settings, scene.shapes, scene.walls);
        engine.bodies() = scene.bodies;
        keep_share(engine, exchange, ranks);
        if (ranks > 1) engine.share_with(exchange);
        engine.max_penetration();
        engine.restore_from({saved});
        keep_share(engine, exchange, ranks);
        for (int step = 0; step < 4; ++step) engine.step(scene.dt), engine.move(scene.dt);
        const std::lock_guard lock(mutex);
        for (std::size_t i = 0; i < engine.bodies().size(); ++i)
            if (engine.bodies().id[i] == id) result = engine.bodies().twist[i].velocity[0];
    });
    return result;
}

// Every rank reads all that is known of contacts; that of a large body must reach the first rank,
// whoever has its other body.
TEST(Ranks, ABondWithALargeBodyGoesOnOnAnotherNumberOfRanks) {
    for (const bool small_first : {true, false}) {
        Scene scene = bonded_pair(small_first);
        scene.bodies.add(scenes::sphere(60, {40.0, 0.0, 0.0}));
        Engine engine(scene.settings, scene.shapes, scene.walls);
        engine.bodies() = scene.bodies;
        for (int step = 0; step < 4; ++step) engine.step(scene.dt), engine.move(scene.dt);
        const std::vector<char> saved = engine.save();
        const GrainId small = small_first ? 50 : 51;
        const double one = velocity_after_restart(scene, saved, small, 1);
        EXPECT_GT(one, 0.005);
        for (const int ranks : {2, 3})
            EXPECT_EQ(velocity_after_restart(scene, saved, small, ranks), one) << ranks;
    }
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
// each, then, as soon as contacts have been counted, half of those.
TEST(Ranks, AreCutAnewWhereTheWorkIsUneven) {
    Scene scene;
    scene.settings = scenes::exact_in_space(0.4, 1e-4);
    scene.walls = {scenes::floor(0.4)};
    GrainId id = 0;
    for (int x = 0; x < 12; ++x)
        for (int z = 0; z < 6; ++z)
            for (int y = 0; y < 3; ++y)
                scene.bodies.add(scenes::sphere(++id, {0.5 + x, 0.5 + y, 0.5 + z}));
    const GrainId of_heap = id;
    for (int i = 0; i < of_heap; ++i)
        scene.bodies.add(scenes::sphere(++id, {30.0 + 2.0 * (i % 20), 50.0, 2.0 * (i / 20)}));
    for (const int steps : {6, 30}) {
        scene.steps = steps;
        const Played one = play(scene, 1), many = play(scene, 2);
        expect_equal(one, many);
        ASSERT_GT(one.contacts, 1000) << steps;
        const auto moved = std::count_if(many.moved.begin(), many.moved.end(),
                                         [of_heap](GrainId moved) { return moved <= of_heap; });
        EXPECT_GT(moved, 50) << steps;
    }
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

}  // namespace
}  // namespace turbidite::nscd
