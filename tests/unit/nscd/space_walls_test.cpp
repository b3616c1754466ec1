// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Spheres at cylinders, cones, plates with a round hole and rectangles: gaps and normals against
// finely sampled surfaces, rims, and joints of walls.
#include "granular_adapter/nscd/detection/space/space_walls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "granular_adapter/nscd/detection/detection.hpp"
#include "round_walls.hpp"

namespace turbidite::nscd {
namespace {

constexpr double far = 100.0;

std::vector<ContactPoint> points_at(const std::vector<Wall>& walls, const Vec3& centre,
                                    double radius, double reach = far) {
    Bodies bodies;
    bodies.add(scenes::sphere(1, centre, radius));
    return Detection(scenes::spheres, {}).points(bodies, walls, {}, reach, 0.0);
}

/// Points all over a wall.
std::vector<Vec3> samples(const Wall& wall, int along, int around) {
    const Vec3 e = std::abs(wall.normal[0]) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    Vec3 p = cross(wall.normal, e);
    p = (1.0 / norm(p)) * p;
    if (wall.form == WallForm::rectangle) p = wall.side;
    const Vec3 q = cross(wall.normal, p);
    std::vector<Vec3> result;
    for (int i = 0; i <= along; ++i)
        for (int j = 0; j <= around; ++j) {
            const double s = double(i) / along, t = double(j) / around;
            if (wall.form == WallForm::rectangle) {
                result.push_back(wall.point + (2 * s - 1) * wall.half_length * p +
                                 (2 * t - 1) * wall.half_width * q);
                continue;
            }
            const auto& [a, b] = wall.meridian;
            const double r = a.radius + s * (b.radius - a.radius);
            const double h = a.height + s * (b.height - a.height);
            const double angle = 2.0 * std::numbers::pi * t;
            result.push_back(wall.point + h * wall.normal + r * std::cos(angle) * p +
                             r * std::sin(angle) * q);
        }
    return result;
}

double distance_to(const std::vector<Vec3>& surface, const Vec3& x) {
    double nearest = far;
    for (const Vec3& place : surface) nearest = std::min(nearest, norm(x - place));
    return nearest;
}

const Vec3 tilted = {1.0 / 3.0, 2.0 / 3.0, -2.0 / 3.0};

struct NamedWall {
    const char* name;
    Wall wall;
};

std::vector<NamedWall> all_kinds() {
    const Vec3 base{0.3, -0.2, 0.1};
    const Vec3 side = {2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0};
    return {{"cylinder", scenes::round_wall(6, base, tilted, {1.5, -1.0}, {1.5, 2.0})},
            {"cone", scenes::round_wall(6, base, tilted, {2.0, 0.0}, {0.7, 1.5})},
            {"full cone", scenes::round_wall(6, base, tilted, {0.0, 0.0}, {1.5, 1.5})},
            {"ring", scenes::round_wall(6, base, tilted, {0.5, 0.2}, {2.0, 0.2})},
            {"disc", scenes::round_wall(6, base, tilted, {0.0, 0.0}, {2.0, 0.0})},
            {"rectangle", scenes::rectangle(6, base, tilted, side, 1.5, 0.8)}};
}

TEST(SpaceWalls, GapsAndNormalsAreThoseOfTheSampledSurface) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> place(-2.5, 2.5);
    for (const auto& [name, wall] : all_kinds()) {
        const std::vector<Vec3> surface = samples(wall, 200, 600);
        int at_rims = 0, at_the_surface = 0;
        for (int n = 0; n < 60; ++n) {
            const Vec3 centre{place(random), place(random), place(random)};
            const double radius = 0.05;
            const auto points = points_at({wall}, centre, radius, far);
            ASSERT_FALSE(points.empty()) << name;
            const ContactPoint& nearest = points.front();
            // Samples are up to a pitch of 0.02 from the nearest place: sqrt(d^2 + 0.01^2) at most.
            const double distance = nearest.gap + radius, sampled = distance_to(surface, centre);
            EXPECT_LE(distance, sampled + 1e-12) << name;
            EXPECT_GE(std::hypot(distance, 0.025), sampled) << name;
            EXPECT_NEAR(norm(nearest.normal), 1.0, 1e-12) << name;
            EXPECT_LT(distance_to(surface, centre - distance * nearest.normal), 0.025) << name;
            EXPECT_LT(norm(nearest.arm_b + radius * nearest.normal), 1e-15) << name;
            ++(nearest.feature == 0 ? at_the_surface : at_rims);
        }
        EXPECT_GT(at_rims, 3) << name;
        EXPECT_GT(at_the_surface, 3) << name;
    }
}

TEST(SpaceWalls, HoldASphereOnTheSideOfItsCentre) {
    const Wall tube = scenes::tube(2.0, 8.0);
    const auto inside = points_at({tube}, {1.7, 0.0, 0.0}, 0.25, 0.1);
    ASSERT_EQ(inside.size(), 1u);
    EXPECT_NEAR(inside[0].gap, 0.05, 1e-12);
    EXPECT_NEAR(inside[0].normal[0], -1.0, 1e-12);
    const auto outside = points_at({tube}, {0.0, 2.3, 0.0}, 0.25, 0.1);
    ASSERT_EQ(outside.size(), 1u);
    EXPECT_NEAR(outside[0].gap, 0.05, 1e-12);
    EXPECT_NEAR(outside[0].normal[1], 1.0, 1e-12);
}

TEST(SpaceWalls, AShellIsThickerByHalfItsThickness) {
    Wall tube = scenes::tube(2.0, 8.0);
    tube.half_thickness = 0.1;
    const auto points = points_at({tube}, {1.6, 0.0, 0.0}, 0.25, 0.1);
    ASSERT_EQ(points.size(), 1u);
    EXPECT_NEAR(points[0].gap, 0.05, 1e-12);
}

TEST(SpaceWalls, ASphereThatJustFitsTouchesAllAround) {
    EXPECT_EQ(points_at({scenes::tube(0.51, 8.0)}, {0.0, 0.0, 0.0}, 0.5, 0.02).size(), 4u);
    EXPECT_EQ(points_at({scenes::tube(0.53, 8.0)}, {0.02, 0.0, 0.0}, 0.5, 0.02).size(), 1u);
}

/// Cylinder above a hopper above a pipe, around y.
std::vector<Wall> silo() {
    const Vec3 y{0, 1, 0};
    return {scenes::round_wall(6, {}, y, {3.0, 2.0}, {3.0, 8.0}),
            scenes::round_wall(7, {}, y, {3.0, 2.0}, {1.0, 0.0}),
            scenes::round_wall(8, {}, -y, {1.0, 0.0}, {1.0, 2.0})};
}

/// Whatever the centre, one point at the rim of hopper and pipe at most, and the nearest place of
/// all walls is always among the points.
TEST(SpaceWalls, AJointIsTouchedOnceOrNotAtAll) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> x(0.3, 1.7), y(-0.7, 0.7);
    const std::vector<Wall> walls = silo();
    int at_the_joint = 0, dropped = 0;
    for (int n = 0; n < 2000; ++n) {
        const Vec3 centre{x(random), y(random), 0.0};
        const auto joined = points_at(walls, centre, 0.1);
        double nearest = far, found = far;
        int rims = 0;
        for (const ContactPoint& point : joined) found = std::min(found, point.gap);
        for (const ContactPoint& point : joined)
            rims += norm(centre - (point.gap + 0.1) * point.normal - Vec3{1, 0, 0}) < 1e-9;
        for (const Wall& wall : walls) {
            const auto alone = points_at({wall}, centre, 0.1);
            nearest = std::min(nearest, alone.front().gap);
        }
        ASSERT_EQ(found, nearest) << centre[0] << " " << centre[1];
        ASSERT_LE(rims, 1) << centre[0] << " " << centre[1];
        at_the_joint += rims;
        dropped += joined.size() < 3;
    }
    EXPECT_GT(at_the_joint, 100);
    EXPECT_GT(dropped, 100);
}

/// A thick cylinder ends at a thin disc that lies on it. Whichever of them is the first, a sphere
/// beyond their rim is held by the round edge of the thicker.
TEST(SpaceWalls, AtARimOfWallsOfTwoThicknessesTheThickerHolds) {
    const Vec3 y{0, 1, 0};
    std::vector<Wall> walls = {scenes::round_wall(6, {}, y, {4.0, 0.0}, {4.0, -4.0}),
                               scenes::round_wall(7, {}, y, {4.0, 0.0}, {0.0, 0.0})};
    walls[0].half_thickness = 0.5;
    for (int order = 0; order < 2; ++order, std::swap(walls[0], walls[1]))
        for (const Vec3& centre : {Vec3{4.3, 0.4, 0.0}, Vec3{4.0, 0.6, 0.0}, Vec3{4.6, 0.1, 0.0}}) {
            const double distance = norm(centre - Vec3{4, 0, 0});
            double smallest = far;
            for (const ContactPoint& point : points_at(walls, centre, 0.25))
                smallest = std::min(smallest, point.gap);
            EXPECT_NEAR(smallest, distance - 0.25 - 0.5, 1e-12) << order << " " << centre[0];
        }
}

/// A sphere slides along a cylinder of two pieces, given in either order: without the rule of
/// joints the rim of the next piece would lift it.
TEST(SpaceWalls, ASphereSlidesOverAJointUnhindered) {
    const Vec3 z{0, 0, 1};
    std::vector<Wall> pieces = {scenes::round_wall(6, {}, z, {4.0, 0.0}, {4.0, 3.0}),
                                scenes::round_wall(7, {}, z, {4.0, 6.0}, {4.0, 3.0})};
    for (int order = 0; order < 2; ++order, std::swap(pieces[0], pieces[1])) {
        Engine engine(scenes::exact_in_space(0.0), scenes::spheres, pieces);
        Body sphere = scenes::sphere(1, {0.0, -3.5, 1.0});
        sphere.twist.velocity = {0.0, 0.0, 1.0};
        engine.bodies().add(sphere);
        int held = 0;
        for (int n = 0; n < 400; ++n) {
            const StepReport report = engine.step(0.01);
            engine.move(0.01);
            held += report.contacts >= 1;  // two right at the joint
        }
        EXPECT_EQ(held, 400) << order;
        EXPECT_NEAR(engine.bodies().position[0][2], 5.0, 1e-12) << order;
        EXPECT_NEAR(engine.bodies().position[0][1], -3.5, 1e-12) << order;
        EXPECT_NEAR(engine.bodies().twist[0].velocity[2], 1.0, 1e-12) << order;
    }
}

TEST(SpaceWalls, AFilledSiloHoldsItsSpheres) {
    std::vector<Wall> walls = silo();
    walls.pop_back();
    walls.push_back(scenes::round_wall(9, {}, {0, 1, 0}, {0.0, 0.0}, {1.0, 0.0}));  // plug
    EngineSettings settings = scenes::exact_in_space(0.3, 1e-4);
    Engine engine(settings, scenes::spheres, walls);
    for (int y = 0; y < 6; ++y)
        for (int x = -3; x <= 3; ++x)
            for (int z = -3; z <= 3; ++z)
                if (x * x + z * z < 10)
                    engine.bodies().add(
                        scenes::sphere(static_cast<GrainId>(engine.bodies().size()) + 1,
                                       {0.7 * x, 3.0 + 0.7 * y, 0.7 * z}, 0.3));
    scenes::run(engine, 8.0, 0.01);
    EXPECT_GT(engine.bodies().size(), 150u);
    int on_the_plug = 0, in_the_hopper = 0;
    for (const ContactPoint& point : engine.points()) {
        if (point.wall < 0) continue;
        on_the_plug += walls[static_cast<std::size_t>(point.wall)].key == 9;
        in_the_hopper += walls[static_cast<std::size_t>(point.wall)].key == 7;
    }
    EXPECT_GT(on_the_plug, 0);
    EXPECT_GT(in_the_hopper, 5);
    for (const Vec3& x : engine.bodies().position) {
        EXPECT_GT(x[1], 0.0);
        EXPECT_LT(std::hypot(x[0], x[2]), std::min(3.0, 1.0 + x[1]));
    }
    EXPECT_LT(engine.max_penetration(), 1e-3);
}

/// Released a little beside the middle of a hole that is smaller than it.
TEST(SpaceWalls, ASphereComesToRestInAHole) {
    Engine engine(scenes::exact_in_space(0.5, 1e-6), scenes::spheres,
                  {scenes::round_wall(6, {}, {0, 1, 0}, {0.3, 0.0}, {2.0, 0.0}, 0.5)});
    engine.bodies().add(scenes::sphere(1, {0.01, 0.45, 0.02}));
    scenes::run(engine, 5.0, 0.005);
    const Vec3& x = engine.bodies().position[0];
    EXPECT_NEAR(x[0], 0.0, 1e-3);
    EXPECT_NEAR(x[2], 0.0, 1e-3);
    EXPECT_NEAR(x[1], 0.4, 1e-3);
    EXPECT_GE(engine.points().size(), 2u);
    EXPECT_NEAR(engine.bodies().contact_impulse[0][1], engine.bodies().mass[0] * 0.005, 1e-5);
}

/// The attraction [N] of a sphere by a wall that it touches in `points` places.
double attraction_by(const Wall& wall, const Vec3& centre, const char* law, std::size_t points) {
    EngineSettings settings = scenes::exact_in_space(0.0, 1e-8);
    settings.gravity = {};
    Surface surface;
    surface.friction = 0.0;
    surface.adhesion = 10.0;
    settings.surfaces = {surface};
    settings.law.adhesion = law;
    settings.law_settings.adhesion_range = 0.05;
    settings.law_settings.adhesion_length = 0.02;
    settings.law_settings.adhesion_shear = 1.0;
    Engine engine(settings, scenes::spheres, {wall});
    engine.bodies().add(scenes::sphere(1, centre));
    constexpr double step = 1e-3;
    double sum = 0.0;
    // A bond or a bridge that forms in the first step pulls from the second on.
    for (int n = 0; n < 2; ++n) {
        engine.step(step);
        EXPECT_EQ(engine.points().size(), points) << law;
        sum = 0.0;
        for (std::size_t k = 0; k < engine.points().size(); ++k)
            sum += (engine.solution()[k].n - engine.impulses()[k].n) / step;
        engine.move(step);
    }
    return sum;
}

// It was pulled, and bonded, by all four places where it touched.
TEST(SpaceWalls, AConePullsASphereThatFitsIntoItOnce) {
    Wall cone = scenes::round_wall(6, {}, {0, 1, 0}, {0.05, 0.05}, {3.0, 3.0});
    Wall floor = scenes::floor(0.0);
    cone.material = floor.material = 0;
    for (const char* law : {"wet", "cohesion", "capillary"}) {
        const double once = attraction_by(floor, {0, 0.5, 0}, law, 1);
        EXPECT_GT(once, 9.0) << law;
        EXPECT_NEAR(attraction_by(cone, {0, std::sqrt(0.5), 0}, law, 4), once, 1e-6 * once) << law;
    }
}

TEST(SpaceWalls, RefuseWhatIsNoSurface) {
    const auto refused = [](const Wall& wall) {
        try {
            Engine(scenes::exact_in_space(0.3), scenes::spheres, {wall});
        } catch (const std::invalid_argument& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(refused(scenes::tube(1.0, 2.0)), "");
    EXPECT_NE(refused(scenes::tube(1.0, 0.0)).find("rims must be apart"), std::string::npos);
    EXPECT_NE(refused(scenes::tube(-1.0, 2.0)).find("radii"), std::string::npos);
    EXPECT_NE(refused(scenes::rectangle(6, {}, {0, 1, 0}, {0, 1, 0}, 1, 1)).find("side"),
              std::string::npos);
    EXPECT_NE(refused(scenes::rectangle(6, {}, {0, 1, 0}, {1, 0, 0}, 1, 0)).find("edges"),
              std::string::npos);
    EXPECT_THROW(Engine(scenes::exact(0.3), scenes::discs, {scenes::tube(1.0, 2.0)}),
                 std::invalid_argument);
}

/// Images across a cyclic side, and their joints, are as solid as the wall.
TEST(SpaceWalls, RepeatWithCyclicSides) {
    EngineSettings settings = scenes::exact_in_space(0.0);
    settings.box.length = {0.0, 0.0, 6.0};
    Engine engine(settings, scenes::spheres,
                  {scenes::round_wall(6, {}, {0, 0, 1}, {4.0, 0.0}, {4.0, 6.0})});
    Body sphere = scenes::sphere(1, {0.0, -3.5, 1.0});
    sphere.twist.velocity = {0.0, 0.0, 1.0};
    engine.bodies().add(sphere);
    scenes::run(engine, 9.0, 0.01);
    EXPECT_NEAR(engine.bodies().position[0][1], -3.5, 1e-12);
    EXPECT_NEAR(engine.bodies().position[0][2], 4.0, 1e-9);
    EXPECT_GT(engine.bodies().contact_impulse[0][1], 0.0);
}

}  // namespace
}  // namespace turbidite::nscd
