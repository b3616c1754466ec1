// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contact engine as an adapter in space: six sides, velocities of three components.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>

#include "granular_adapter/nscd_adapter/nscd_adapter.hpp"
#include "tests/unit/nscd_adapter/contact_case.hpp"

namespace turbidite {
namespace {

/// A dry box of 10 x 20 x 6 with walls on all sides, g = 1.
Settings space_box() {
    Settings s = box_settings();
    s.set("dimension", std::int64_t{3});
    s.set("fluid.enabled", false);
    s.set("run.dimension", std::int64_t{3});
    s.set("run.size_z", 6.0);
    s.set("run.acceleration_z", 0.0);
    for (const char* side : {"front", "back"})
        s.set(std::string("domain.") + side, std::string("wall"));
    return s;
}

GrainState sphere_at(GrainId id, const Vec3& place, const Vec3& velocity = {}) {
    GrainState grain = grain_at(id, place[0], place[1]);
    grain.position = place;
    grain.velocity = velocity;
    return grain;
}

const ShapeTable spheres = {{"sphere", {}}};

/// An adapter that plays dry windows.
struct Player {
    NscdAdapter adapter;
    Motion state;
    Window window;

    Player(const Settings& settings, const std::vector<GrainState>& grains) {
        window.step = settings.real("run.step");
        state = adapter.initialise(settings, spheres, grains);
    }
    void play(int windows) {
        for (int i = 0; i < windows; ++i) {
            adapter.advance(window, {});
            window.write_output = true;
            state = adapter.apply_kick(window, {});
            window.time += window.step;
            ++window.index;
        }
    }
};

TEST(NscdAdapterInSpace, PlaysInBothDimensions) {
    const Hello hello = NscdAdapter().describe();
    EXPECT_EQ(hello.dimension, both_dimensions);
    EXPECT_NE(
        std::find(hello.capabilities.shapes.begin(), hello.capabilities.shapes.end(), "sphere"),
        hello.capabilities.shapes.end());
}

// Two contacts of three components: with the floor, and between the spheres.
TEST(NscdAdapterInSpace, WritesContactProblems) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) /
                                         ("dumps-in-space-" + std::to_string(::getpid()));
    Settings settings = space_box();
    settings.set("time.step", 0.01);
    settings.set("contact.dump_interval", 0.01);
    NscdAdapter adapter;
    adapter.set_run_folder(folder);
    adapter.initialise(settings, spheres,
                       {sphere_at(1, {5.0, 0.5, 3.0}), sphere_at(2, {5.0, 1.5, 3.0})});
    Window window;
    window.step = 0.01;
    adapter.advance(window, {});
    adapter.apply_kick(window, {});
    std::ifstream file(folder / "contacts" / "problem_1.dat");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    EXPECT_EQ(text.substr(0, 10), "3\n2\n1\n6\n6\n");
    std::filesystem::remove_all(folder);
}

TEST(NscdAdapterInSpace, ASphereFallsOnTheFloorAndStays) {
    Player player(space_box(), {sphere_at(0, {5.0, 1.0, 3.0})});
    player.play(50);
    EXPECT_NEAR(player.state.grains[0].position[1], 1.0 - 0.5 * 0.51 * 0.5, 1e-12);
    player.play(200);
    EXPECT_NEAR(player.state.grains[0].position[1], 0.5, 1e-3);
    ASSERT_EQ(player.state.contacts->size(), 1u);
    EXPECT_EQ(player.state.contacts->front().wall, 2);
    // m g dt with m = rho_s pi/6
    EXPECT_NEAR(player.state.contacts->front().impulse[1], 1.5 * std::numbers::pi / 6.0 * 0.01,
                1e-8);
}

TEST(NscdAdapterInSpace, TheFourthPairOfSidesHoldsGrains) {
    Player player(space_box(), {sphere_at(0, {3.0, 10.0, 1.0}, {0, 0, -2}),
                                sphere_at(1, {7.0, 10.0, 5.0}, {0, 0, 2})});
    std::set<std::int32_t> walls;
    for (int window = 0; window < 40; ++window) {
        player.play(1);
        for (const ContactRecord& contact : *player.state.contacts) walls.insert(contact.wall);
    }
    EXPECT_NEAR(player.state.grains[0].position[2], 0.5, 1e-9);
    EXPECT_NEAR(player.state.grains[1].position[2], 5.5, 1e-9);
    EXPECT_EQ(walls, (std::set<std::int32_t>{4, 5}));
}

TEST(NscdAdapterInSpace, GrainsLeaveThroughAFreeBack) {
    Settings s = space_box();
    s.set("domain.back", std::string("free"));
    Player player(s, {sphere_at(0, {3.0, 10.0, 5.5}, {0, 0, 3}), sphere_at(1, {7.0, 10.0, 3.0})});
    player.play(40);
    ASSERT_EQ(player.state.grains.size(), 1u);
    EXPECT_EQ(player.state.grains[0].id, 1);
}

// A sphere that spins about the vertical on the floor: I dw = -mu_t R m g dt, until it rests.
TEST(NscdAdapterInSpace, TorsionStopsASpinAboutTheNormal) {
    Settings s = space_box();
    s.set("contact.torsion_friction", 0.1);
    GrainState spinning = sphere_at(0, {5.0, 0.5, 3.0});
    spinning.angular_velocity = {0, 2, 0};
    Player player(s, {spinning});
    player.play(100);
    // mu_t R m g/I = 0.1 R/(0.4 R^2) = 0.5
    EXPECT_NEAR(player.state.grains[0].angular_velocity[1], 2.0 - 0.5, 1e-6);
    EXPECT_NEAR(player.state.contacts->front().rolling_impulse[1],
                -0.1 * 0.5 * 1.5 * std::numbers::pi / 6.0 * 0.01, 1e-9);
    player.play(350);
    EXPECT_NEAR(player.state.grains[0].angular_velocity[1], 0.0, 1e-9);
}

TEST(NscdAdapterInSpace, DepthMayBeCyclic) {
    Settings s = space_box();
    for (const char* side : {"front", "back"})
        s.set(std::string("domain.") + side, std::string("cyclic"));
    // They meet across z = 0, of equal masses and without restitution.
    Player player(
        s, {sphere_at(0, {5.0, 10.0, 0.8}, {0, 0, -1}), sphere_at(1, {5.0, 10.0, 5.2}, {0, 0, 1})});
    player.play(60);
    EXPECT_NEAR(player.state.grains[0].velocity[2], 0.0, 1e-9);
    const double apart = player.state.grains[0].position[2] - player.state.grains[1].position[2];
    EXPECT_NEAR(std::abs(apart - 6.0 * std::round(apart / 6.0)), 1.0, 1e-6);
}

// The floor moves along z and takes the sphere with it: v = mu g t until it rolls or sticks.
TEST(NscdAdapterInSpace, AMovingFloorDragsAlongZ) {
    Settings s = space_box();
    s.set("run.wall_motions", std::string("2 constant 0 0 4 0 0 0"));
    Player player(s, {sphere_at(0, {5.0, 0.5, 2.0})});
    player.play(50);
    EXPECT_NEAR(player.state.grains[0].velocity[2], 0.3 * 0.5, 1e-6);
    EXPECT_GT(std::abs(player.state.grains[0].angular_velocity[0]), 0.1);
    EXPECT_NEAR(player.state.grains[0].velocity[0], 0.0, 1e-12);
}

/// A cylinder around y of radius 2, of the second material, with a disc as its bottom.
constexpr const char* cup =
    "0 cylinder 5 4 3 0 6 0 0 0 0 2 0 0 0 0 0 0 0 0 5 4 3 0.3 1;"
    "1 ring 5 4 3 0 1 0 0 0 0 0 2 0 0 0 0 0 0 0 5 4 3 0.3 1";

TEST(NscdAdapterInSpace, WallsInsideTheBoxHoldGrains) {
    Settings s = space_box();
    s.set("run.walls", std::string(cup));
    s.set("run.materials", std::string("ice"));
    s.set("contact.materials.ice.friction", 0.0);
    std::vector<GrainState> grains;
    for (GrainId id = 0; id < 4; ++id)
        grains.push_back(sphere_at(id, {5.0 + 0.6 * (id % 2), 5.0 + 1.1 * id, 3.0}, {1.0, 0, 0}));
    Player player(s, grains);
    player.play(400);
    std::set<std::int32_t> touched;
    for (const ContactRecord& contact : *player.state.contacts)
        if (contact.wall >= 0) touched.insert(contact.wall);
    EXPECT_EQ(touched, (std::set<std::int32_t>{6, 7}));
    for (const GrainState& grain : player.state.grains) {
        EXPECT_LE(std::hypot(grain.position[0] - 5, grain.position[2] - 3), 1.5 + 1e-3);
        EXPECT_GE(grain.position[1], 4.5 - 1e-3);
    }
}

/// The disc turns; without its material's friction it would not turn the sphere.
TEST(NscdAdapterInSpace, WallsHaveMaterialsAndMotions) {
    for (const bool rough : {false, true}) {
        Settings s = space_box();
        s.set("run.walls", std::string(cup));
        s.set("run.materials", std::string("ice"));
        s.set("contact.materials.ice.friction", rough ? 0.3 : 0.0);
        s.set("run.wall_motions", std::string("7 constant 0 0 0 0 2 0"));
        Player player(s, {sphere_at(0, {6.0, 4.5, 3.0})});
        player.play(20);
        // The disc moves along -z there.
        if (rough)
            EXPECT_LT(player.state.grains[0].velocity[2], -0.02);
        else
            EXPECT_EQ(player.state.grains[0].velocity[2], 0.0);
        EXPECT_GT(player.state.grains[0].contact_impulse[1], 0.0);
    }
}

TEST(NscdAdapterInSpace, SidesHaveAMaterial) {
    Settings s = space_box();
    s.set("run.materials", std::string("ice"));
    s.set("contact.materials.ice.friction", 0.0);
    s.set("run.side_material", std::int64_t{1});
    Player player(s, {sphere_at(0, {5.0, 0.5, 3.0}, {1.0, 0, 0})});
    player.play(20);
    EXPECT_NEAR(player.state.grains[0].velocity[0], 1.0, 1e-12);
    EXPECT_GT(player.state.grains[0].contact_impulse[1], 0.0);
}

TEST(NscdAdapterInSpace, WallsOfAnotherFormAreRefused) {
    for (const char* text :
         {"0 cube 5 4 3 0 6 0 0 0 0 2 0 0 0 0 0 0 0 0 5 4 3 0.3 1", "0 plate 1 2 3",
          "0 cylinder 5 4 3 0 6 0 0 0 0 2 0 0 0 0 0 0 0 0 5 4 3 0.3 x",
          "0 cylinder 5 4 3 0 6 0 0 0 0 0 0 0 0 0 0 0 0 0 5 4 3 0.3 -1"}) {
        Settings s = space_box();
        s.set("run.walls", std::string(text));
        EXPECT_THROW(Player(s, {}), std::invalid_argument) << text;
    }
}

TEST(NscdAdapterInSpace, GrainsFollowMotionsAboutAnyAxis) {
    Settings s = space_box();
    s.set("run.grain_motions", std::string("0 constant 0 0 1 0 2 0"));
    GrainState driven = sphere_at(0, {5.0, 10.0, 2.0});
    driven.prescribed = true;
    Player player(s, {driven});
    player.play(50);
    const GrainState& now = player.state.grains[0];
    EXPECT_NEAR(now.position[2], 2.5, 1e-12);
    EXPECT_NEAR(now.orientation[0], std::cos(0.5), 1e-12);
    EXPECT_NEAR(now.orientation[2], std::sin(0.5), 1e-12);
}

TEST(NscdAdapterInSpace, AStateRestoredGoesOnWithEqualBits) {
    std::vector<GrainState> grains;
    for (GrainId id = 0; id < 60; ++id)
        grains.push_back(
            sphere_at(id, {1.0 + 1.3 * (id % 4), 0.6 + 1.1 * (id / 12), 1.0 + 1.2 * (id / 4 % 3)},
                      {0.1 * (id % 5), 0.0, 0.1 * (id % 3)}));
    Player whole(space_box(), grains);
    whole.play(60);
    const SavedState saved = whole.adapter.save();
    Player second(space_box(), grains);
    second.adapter.restore(saved);
    second.window = whole.window;
    whole.play(40), second.play(40);
    ASSERT_EQ(whole.state.grains.size(), second.state.grains.size());
    EXPECT_GT(whole.state.contacts->size(), 20u);
    for (std::size_t i = 0; i < whole.state.grains.size(); ++i) {
        EXPECT_EQ(whole.state.grains[i].position, second.state.grains[i].position);
        EXPECT_EQ(whole.state.grains[i].angular_velocity, second.state.grains[i].angular_velocity);
    }
}

}  // namespace
}  // namespace turbidite
