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

}  // namespace
}  // namespace turbidite::nscd
