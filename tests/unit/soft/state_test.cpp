// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Grains that leave, and a run that goes on from a saved state.
#include <gtest/gtest.h>

#include "tests/unit/soft/soft_case.hpp"

namespace turbidite::soft {
namespace {

/// Some of each shape, above each other.
std::vector<nscd::Body> heap() {
    std::vector<nscd::Body> list;
    for (int i = 0; i < 24; ++i)
        list.push_back(grain(Kind(i % 3), 100 - 3 * i, 2.0 + 1.1 * (i % 4) + 0.07 * (i % 5),
                             0.6 + 1.15 * (i / 4), {}, 0.5 * i));
    return list;
}

Settings heap_settings() {
    Settings settings = heavy(0.5);
    settings.set("run.size_x", 7.5);
    return settings;
}

constexpr double coarse = 60.0 * fine;

void expect_equal(const nscd::Bodies& one, const nscd::Bodies& other) {
    EXPECT_EQ(one.position, other.position);
    EXPECT_EQ(one.orientation, other.orientation);
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one.twist[i].velocity, other.twist[i].velocity);
        EXPECT_EQ(one.twist[i].spin, other.twist[i].spin);
    }
}

TEST(SoftState, GoesOnInEveryDigitWithItsSprings) {
    Scene whole(heap_settings(), heap()), second(heap_settings(), heap()),
        without(heap_settings(), heap());
    whole.play(4000, coarse);
    second.host.restore(whole.host.save());
    without.host.write(whole.bodies);
    second.bodies = without.bodies = whole.bodies;
    for (Scene* scene : {&whole, &second, &without})
        EXPECT_GT(scene->play(4000, coarse).contacts, 18);
    expect_equal(second.bodies, whole.bodies);
    EXPECT_NE(without.bodies.position, whole.bodies.position);
}

TEST(SoftState, GoesBackWithinAWindow) {
    Scene scene(heap_settings(), heap());
    scene.play(3000, coarse);
    const SavedState state = scene.host.save();
    scene.play(1000, coarse);
    const nscd::Bodies once = scene.bodies;
    scene.host.restore(state);
    scene.play(1000, coarse);
    expect_equal(scene.bodies, once);
}

TEST(SoftState, ForgetsGrainsThatLeave) {
    Scene scene(heavy(1.0), {grain(triangle, 1, 3.0, 0.25), grain(disc, 2, 5.0, 0.5),
                             grain(triangle, 3, 7.0, 0.25)});
    EXPECT_EQ(scene.play(2000, coarse).contacts, 5);
    scene.bodies.keep({0, 1, 1}), scene.host.keep({0, 1, 1});
    EXPECT_EQ(scene.play(2000, coarse).contacts, 3);
    EXPECT_NEAR(scene.bodies.position[1][0], 7.0, 1e-9);
    scene.bodies.keep({0, 0}), scene.host.keep({0, 0});
    EXPECT_EQ(scene.play(10, coarse).contacts, 0);
}

}  // namespace
}  // namespace turbidite::soft
