// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Soft grains as a participant beside the contact engine, which knows the same shapes.
#include <gtest/gtest.h>

#include "granular_adapter/md/md_adapter.hpp"
#include "granular_adapter/nscd_adapter/nscd_adapter.hpp"
#include "tests/unit/soft/soft_case.hpp"

namespace turbidite::soft {
namespace {

constexpr double dt = 0.01;
const ShapeTable triangles = {{"triangle", {}}};

Window window(std::int64_t index) {
    return {index, double(index) * dt, dt, true};
}

GrainState triangle_at(GrainId id, double x, double y, double angle) {
    GrainState state = grain_at(id, x, y);
    state.radius = 0.75;
    state.orientation = {std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle)};
    return state;
}

/// A closed box, 6 x 20.
Settings box(bool wet) {
    Settings settings = box_settings();
    settings.set("fluid.enabled", wet);
    settings.set("run.size_x", 6.0);
    settings.set("contact.tolerance", 1e-4);
    settings.set("contact.iterations", std::int64_t{500});
    settings.set("run.md_frequency", 500.0), settings.set("run.md_damping", 1.0);
    settings.set("run.md_substeps", std::int64_t{32});
    settings.set("run.step", dt);
    settings.set("coupling.md_hold", true);
    return settings;
}

Kick some_kick(GrainId id, std::int64_t n) {
    const double t = double(n);
    Kick kick;
    kick.id = id;
    kick.velocity = {0.3 * std::sin(t), -0.2 - 0.1 * std::cos(t), 0.0};
    kick.angular_velocity = {0.0, 0.0, std::sin(2.0 * t)};
    kick.multiplier_impulse = {0.01 * std::cos(t), 0.004 * t, 0.0};
    kick.multiplier_angular_impulse = {0.0, 0.0, 0.002 * std::cos(t)};
    return kick;
}

TEST(SoftTriangles, ThatTouchNothingMoveAsUnderTheContactEngine) {
    SoftMdHost host;
    MdAdapter md("standalone-md", host);
    NscdAdapter nscd;
    const std::vector<GrainState> grains = {triangle_at(7, 3.0, 10.0, 0.4)};
    md.initialise(box(true), triangles, grains), nscd.initialise(box(true), triangles, grains);
    for (std::int64_t n = 0; n < 20; ++n) {
        md.advance(window(n), {}), nscd.advance(window(n), {});
        const GrainState moved = md.apply_kick(window(n), {some_kick(7, n)}).grains[0];
        const GrainState same = nscd.apply_kick(window(n), {some_kick(7, n)}).grains[0];
        for (int axis = 0; axis < 2; ++axis)
            EXPECT_NEAR(moved.position[axis], same.position[axis], 1e-13);
        for (int part = 0; part < 4; ++part)
            EXPECT_NEAR(moved.orientation[part], same.orientation[part], 1e-13);
        EXPECT_EQ(moved.velocity, same.velocity);
    }
}

struct Course {
    std::vector<double> height, speed;  ///< means, in every window
    double overlap = 0.0;
};

Course dry_course(GrainsAdapter& adapter, const std::vector<GrainState>& grains, int windows) {
    Course course;
    adapter.initialise(box(false), triangles, grains);
    for (std::int64_t n = 0; n < windows; ++n) {
        course.overlap =
            std::max(course.overlap, adapter.advance(window(n), {}).report.max_penetration);
        double height = 0.0, speed = 0.0;
        for (const GrainState& grain : adapter.apply_kick(window(n), {}).grains)
            height += grain.position[1], speed += norm(grain.velocity);
        course.height.push_back(height / double(grains.size()));
        course.speed.push_back(speed / double(grains.size()));
    }
    return course;
}

// Twenty-four triangles fall into a box and come to rest as a heap.
TEST(SoftTriangles, MakeAHeapLikeThatOfTheContactEngine) {
    std::vector<GrainState> grains;
    for (int i = 0; i < 24; ++i)
        grains.push_back(
            triangle_at(i, 1.0 + 1.9 * (i % 3) + 0.1 * (i % 2), 1.0 + 1.7 * (i / 3), 0.7 * i));
    SoftMdHost host;
    MdAdapter md("standalone-md", host);
    NscdAdapter nscd;
    const int windows = 1500;
    const Course soft = dry_course(md, grains, windows), rigid = dry_course(nscd, grains, windows);
    EXPECT_GT(soft.overlap, 1e-4);
    EXPECT_LT(soft.overlap, 0.02);
    EXPECT_LT(rigid.height.back(), 0.6 * rigid.height.front());
    double apart = 0.0;
    for (int n = 0; n < windows; ++n)
        apart = std::max(apart, std::abs(soft.height[n] - rigid.height[n]));
    EXPECT_LT(apart, 0.05 * rigid.height.front());
    EXPECT_NEAR(soft.height.back(), rigid.height.back(), 0.05 * rigid.height.back());
    EXPECT_LT(soft.speed.back(), 1e-3);
    EXPECT_LT(rigid.speed.back(), 1e-3);
    const auto peak = [](const Course& c) {
        return *std::max_element(c.speed.begin(), c.speed.end());
    };
    EXPECT_NEAR(peak(soft), peak(rigid), 0.05 * peak(rigid));
}

}  // namespace
}  // namespace turbidite::soft
