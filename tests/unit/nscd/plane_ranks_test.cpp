// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Engines that share a configuration in the plane have the same bits on two, three and four ranks.
// One engine with all of it takes contacts in another order, and agrees to the tolerance.
#include "polygons.hpp"
#include "rank_scenes.hpp"

namespace turbidite::nscd {
namespace {

using scenes::expect_equal, scenes::play, scenes::Played, scenes::Scene;

/// Discs that slide along x over a floor, in a heap of many cells.
Scene slide(int columns = 60, int rows = 5) {
    Scene scene;
    scene.settings = scenes::exact(0.4, 1e-4);
    scene.shapes = scenes::discs;
    scene.bodies = scenes::settling_pack(columns, rows, scene.settings).bodies();
    scene.walls = {scenes::floor(0.4)};
    for (Twist& twist : scene.bodies.twist) twist.velocity = {4.0, -1.0, 0.0};
    return scene;
}

/// Plays on two ranks, asserts that it means something, and compares with three and four.
Played expect_same_on_ranks(const Scene& scene, std::int64_t contacts, std::size_t moved) {
    const Played two = play(scene, 2);
    EXPECT_GT(two.contacts, contacts);
    EXPECT_GT(two.moved.size(), moved) << "bodies have to change their rank";
    EXPECT_GT(two.doubles, 1000u);
    for (const int ranks : {3, 4}) {
        const Played many = play(scene, ranks);
        expect_equal(two, many);
        EXPECT_EQ(many.empty_ranks, 0u);
    }
    return two;
}

double largest_difference(const Played& a, const Played& b) {
    double largest = 0.0;
    for (const auto& [id, grain] : a.grains) {
        const Played::Grain& other = b.grains.at(id);
        largest = std::max({largest, norm(grain.position - other.position),
                            norm(grain.twist.velocity - other.twist.velocity),
                            norm(grain.twist.spin - other.twist.spin)});
    }
    return largest;
}

TEST(PlaneRanks, HaveTheSameBits) {
    expect_same_on_ranks(slide(70), 5000, 5);
}

TEST(PlaneRanks, AgreeWithOneRankToTheTolerance) {
    Scene scene = slide(50, 4);
    scene.settings.solver_settings.tolerance = 1e-10;
    scene.steps = 45;
    const Played one = play(scene, 1), many = play(scene, 3);
    ASSERT_EQ(one.grains.size(), many.grains.size());
    ASSERT_GT(many.contacts, 1000);
    EXPECT_LT(largest_difference(one, many), 1e-7);
    EXPECT_GT(largest_difference(one, many), 0.0) << "contacts are in another order";
}

TEST(PlaneRanks, HaveTheSameBitsInAPeriodicBox) {
    Scene scene = slide(60, 4);
    scene.settings.box.length = {66.0, 0.0, 0.0};
    for (Twist& twist : scene.bodies.twist) twist.velocity = {9.0, -1.0, 0.0};
    expect_same_on_ranks(scene, 4000, 20);
}

TEST(PlaneRanks, HaveTheSameBitsWithLargeAndFixedBodies) {
    Scene scene = slide(50, 4);
    scene.bodies.fixed[100] = 1;
    scene.bodies.twist[100] = {};
    for (const double x : {10.0, 30.0}) {
        Body large = scenes::disc(static_cast<GrainId>(5000 + x), x, 8.0, 2.5);
        large.twist.velocity = {0.0, -4.0, 0.0};
        scene.bodies.add(large);
    }
    const Played two = expect_same_on_ranks(scene, 3000, 5);
    const auto of_large = std::count_if(
        two.impulses.begin(), two.impulses.end(),
        [](const auto& x) { return x.first.second >= 5000 && x.second.first.n > 0.0; });
    EXPECT_GT(of_large, 3);
}

// Some contacts resist rolling, others do not: which rows sweeps use is one choice of all ranks.
TEST(PlaneRanks, HaveTheSameBitsWithEveryLaw) {
    Scene scene = slide(50, 4);
    Surface plain;
    plain.friction = plain.static_friction = 0.3;
    Surface every = plain;
    every.static_friction = 0.5;
    every.restitution = 0.4;
    every.restitution_tangential = 0.2;
    every.rolling_friction = 0.1;
    every.adhesion = 0.5;
    scene.settings.surfaces = {plain, every};
    scene.settings.law.friction = "static-dynamic";
    scene.settings.law.adhesion = "cohesion";
    scene.settings.law_settings.adhesion_range = 0.01;
    scene.settings.law_settings.adhesion_shear = 1.0;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        scene.bodies.material[i] = scene.bodies.position[i][0] < 10.0 ? 1 : 0;
    for (Wall& wall : scene.walls) wall.material = 0;
    const Played two = expect_same_on_ranks(scene, 2000, 5);
    const auto rolling = std::count_if(two.impulses.begin(), two.impulses.end(),
                                       [](const auto& x) { return x.second.first.roll != 0.0; });
    EXPECT_GT(rolling, 5);
}

TEST(PlaneRanks, HaveTheSameBitsWithFilms) {
    Scene scene = slide(50, 4);
    scene.settings.law.film = "lubrication";
    scene.settings.law_settings.viscosity = 0.003;
    scene.settings.law_settings.film_cutoff = 0.1;
    scene.settings.law_settings.film_roughness = 0.001;
    const Played two = expect_same_on_ranks(scene, 1000, 5);
    const auto pulling = std::count_if(two.impulses.begin(), two.impulses.end(),
                                       [](const auto& x) { return x.second.first.n < 0.0; });
    EXPECT_GT(pulling, 20) << "films that part";
}

// What films carry is found with an operator that asks all ranks, those without a contact too.
TEST(PlaneRanks, HaveFilmsWhereOthersHaveNoContact) {
    Scene scene;
    scene.settings = scenes::exact(0.3, 1e-4);
    scene.settings.law.film = "lubrication";
    scene.settings.law_settings.viscosity = 0.003;
    scene.settings.law_settings.film_cutoff = 0.1;
    scene.settings.law_settings.film_roughness = 0.001;
    scene.shapes = scenes::discs;
    scene.steps = 3;
    scene.bodies.add(scenes::disc(1, 1.0, 5.0));
    scene.bodies.add(scenes::disc(3, 8.0, 5.0));
    scene.bodies.add(scenes::disc(2, 2.05, 5.0));
    scene.bodies.add(scenes::disc(4, 12.0, 5.0));
    scene.bodies.twist[0].velocity = {0.1, 0.0, 0.0};
    const Played two = play(scene, 2);
    ASSERT_EQ(two.impulses.size(), 1u) << "one rank has none";
    EXPECT_GT(two.impulses.begin()->second.first.n, 0.0);
}

/// Triangles that tumble over the floor.
Scene tumble() {
    Scene scene;
    scene.settings = scenes::exact(0.3, 1e-3);
    Engine engine = scenes::falling_triangles(80, 40.0, 8.0, scene.settings);
    scene.bodies = engine.bodies();
    scene.walls = engine.walls();
    scene.shapes = {{"triangle", {}}};
    scene.steps = 80;
    for (Twist& twist : scene.bodies.twist)
        twist.velocity = {3.0, -3.0, 0.0}, twist.spin = {0.0, 0.0, 4.0};
    return scene;
}

TEST(PlaneRanks, HaveTheSameBitsWithPolygons) {
    const Played two = expect_same_on_ranks(tumble(), 1000, 5);
    const auto of_second_corner = std::count_if(two.impulses.begin(), two.impulses.end(),
                                                [](const auto& x) { return x.first.feature > 1; });
    EXPECT_GT(of_second_corner, 20);
}

TEST(PlaneRanks, AreRefusedForASolverOfOneRank) {
    on_ranks(2, [](MemoryExchange& exchange) {
        EngineSettings settings = scenes::exact(0.3);
        settings.solver = "central-path";
        Engine engine(settings, scenes::discs, {});
        EXPECT_THROW(engine.share_with(exchange), std::invalid_argument);
    });
}

}  // namespace
}  // namespace turbidite::nscd
