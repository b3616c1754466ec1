// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Laws that act across a gap, where walls meet: under or above the common edge of two plates a
// round grain feels what it feels at one plate in their place.
#include "granular_adapter/nscd/detection/common_edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "polygons.hpp"
#include "round_walls.hpp"

namespace turbidite::nscd {
namespace {

constexpr double dt = 0.01, range = 0.05, c = 0.6;

/// In the plane, from x1 to x2 at y = 0.
Wall plate(std::int32_t key, double x1, double x2, double thickness = 0.0) {
    Wall wall = scenes::wall(key, {0.5 * (x1 + x2), 0, 0}, {0, 1, 0}, 0.0);
    wall.half_length = 0.5 * (x2 - x1);
    wall.half_thickness = 0.5 * thickness;
    return wall;
}

/// In the plane, upwards from (x, 0).
Wall post(std::int32_t key, double x, double height) {
    Wall wall = scenes::wall(key, {x, 0.5 * height, 0}, {1, 0, 0}, 0.0);
    wall.half_length = 0.5 * height;
    return wall;
}

EngineSettings sticky(const std::string& law) {
    return scenes::adhesive(law, c, range);
}

/// The momentum that a disc of radius 0.5 at (x, y) gains in a step.
Vec3 pull(const std::vector<Wall>& walls, double x, double y, const std::string& law = "wet") {
    Engine engine(sticky(law), scenes::discs, walls);
    engine.bodies().add(scenes::disc(1, x, y));
    engine.step(dt);
    return engine.bodies().mass[0] * engine.bodies().twist[0].velocity;
}

std::vector<std::vector<Wall>> in_any_order(std::vector<Wall> walls) {
    std::vector<std::vector<Wall>> orders;
    const auto before = [](const Wall& v, const Wall& w) { return v.key < w.key; };
    std::sort(walls.begin(), walls.end(), before);
    do orders.push_back(walls);
    while (std::next_permutation(walls.begin(), walls.end(), before));
    return orders;
}

TEST(Walls, KnowWhatIsOnThem) {
    constexpr double rounding = 1e-9;
    const Wall segment = plate(1, -1.0, 3.0);
    EXPECT_TRUE(is_on(segment, {3.0, 0.0, 0.0}, rounding));
    EXPECT_FALSE(is_on(segment, {3.001, 0.0, 0.0}, rounding));
    EXPECT_FALSE(is_on(segment, {0.0, 0.001, 0.0}, rounding));
    const Wall rectangle = scenes::rectangle(1, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, 2.0, 0.5);
    EXPECT_TRUE(is_on(rectangle, {3.0, 0.0, -0.5}, rounding));
    EXPECT_FALSE(is_on(rectangle, {3.001, 0.0, 0.0}, rounding));
    EXPECT_FALSE(is_on(rectangle, {0.0, 0.0, 0.501}, rounding));
    EXPECT_FALSE(is_on(rectangle, {0.0, 0.001, 0.0}, rounding));
    const Wall tube = scenes::tube(2.0, 6.0);
    EXPECT_TRUE(is_on(tube, {0.0, -2.0, 3.0}, rounding));
    EXPECT_FALSE(is_on(tube, {0.0, -2.0, 3.001}, rounding));
    EXPECT_FALSE(is_on(tube, {0.0, 0.0, 0.0}, rounding));
}

// Whatever the place, order and thickness of the plates, across a gap and in touch, where the edge
// holds the disc as well, along a normal that 1e-7 beside it is turned by 2e-7.
TEST(CommonEdges, TwoPlatesPullADiscAsOneDoes) {
    for (const double thickness : {0.0, 0.2})
        for (const double x : {0.0, 1e-12, -1e-7, 0.003, 0.1, -0.15, 1.0})
            for (const double gap : {0.02, 0.0}) {
                const double y = -0.5 - gap - 0.5 * thickness;
                const Vec3 one = pull({plate(1, -5, 5, thickness)}, x, y);
                EXPECT_NEAR(one[1], gap > 0.0 ? c * dt : 0.0, 1e-12);
                for (const auto& walls :
                     in_any_order({plate(1, -5, 0, thickness), plate(2, 0, 5, thickness)}))
                    EXPECT_LT(norm(pull(walls, x, y) - one), gap > 0.0 ? 1e-12 : 2e-7 * c * dt)
                        << x << " " << gap;
            }
}

// Plates that all end at the place of the disc count once; the sides of a corner, from inside, are
// two places.
TEST(CommonEdges, CornersPullOnceFromOutsideAndTwiceFromInside) {
    for (const auto& walls : in_any_order({plate(1, -5, 0), post(2, 0, 5), plate(3, 0, 5)}))
        EXPECT_LT(norm(pull(walls, 0.0, -0.52) - Vec3{0, c * dt, 0}), 1e-12);
    for (const auto& walls : in_any_order({plate(1, 0, 5), post(2, 0, 5)})) {
        EXPECT_LT(norm(pull(walls, 0.52, 0.52) - Vec3{-c * dt, -c * dt, 0}), 1e-12);
        EXPECT_LT(
            norm(pull(walls, -0.3, -0.42) - c * dt / norm(Vec3{0.3, 0.42, 0}) * Vec3{0.3, 0.42, 0}),
            1e-12);
    }
}

// A thin plate that ends at the round end of a thick one is farther away, though both are in range.
TEST(CommonEdges, TheThickerWallPulls) {
    for (const auto& walls : in_any_order({plate(1, -5, 0, 0.04), plate(2, 0, 5)}))
        EXPECT_LT(norm(pull(walls, 0.0, -0.54) - Vec3{0, c * dt, 0}), 1e-12);
}

/// The pull in every step of a disc so heavy that it goes its way.
std::vector<double> pulls_along(const std::vector<Wall>& walls, const std::string& law) {
    Engine engine(sticky(law), scenes::discs, walls);
    Body disc = scenes::disc(1, -0.2, -0.5);
    disc.mass *= 1e9;
    disc.rotation_blocked = true;
    disc.twist.velocity = {0.4, 0.0, 0.0};
    engine.bodies().add(disc);
    std::vector<double> result;
    for (int n = 0; n < 100; ++n) {
        engine.step(dt);
        double sum = 0.0;
        for (const ContactVector& r : engine.impulses()) sum += r.n;
        result.push_back(sum);
        engine.move(dt);
        // It leaves the wall a little after the first step.
        if (n == 0) engine.bodies().position[0][1] -= 0.01;
    }
    return result;
}

// A bridge that stretches across a gap slides along from plate to plate.
TEST(CommonEdges, ABridgeGoesOverTheJoint) {
    for (const char* law : {"capillary", "wet-irreversible"}) {
        const std::vector<double> one = pulls_along({plate(1, -5, 5)}, law);
        EXPECT_LT(one.back(), -0.1 * c * dt) << law;
        for (const auto& walls : in_any_order({plate(1, -5, 0), plate(2, 0, 5)})) {
            const std::vector<double> two = pulls_along(walls, law);
            for (std::size_t n = 1; n < one.size(); ++n)
                ASSERT_NEAR(two[n], one[n], 1e-10) << law << n;
        }
    }
}

// A bond gives way at its strength, not at twice that: with half of it beyond, in the first step.
TEST(CommonEdges, ABondAtAJointIsOne) {
    for (const auto& walls : in_any_order({plate(1, -5, 0), plate(2, 0, 5)}))
        for (const double share : {0.99, 1.5}) {
            Engine engine(sticky("cohesion"), scenes::discs, walls);
            engine.bodies().add(scenes::disc(1, 0.0, -0.5));
            engine.bodies().force[0] = {0.0, -share * c, 0.0};
            engine.step(dt);
            const double gained = engine.bodies().mass[0] * engine.bodies().twist[0].velocity[1];
            EXPECT_NEAR(gained, -std::max(share - 1.0, 0.0) * c * dt, 1e-12);
        }
}

// Beside polygons, whose points share the force of a pair, a disc feels one plate as well.
TEST(CommonEdges, DiscsAmongPolygonsAsWell) {
    const ShapeTable shapes = {{"disc", {}}, scenes::square_record()};
    Engine engine(sticky("wet"), shapes, {plate(1, -5, 0), plate(2, 0, 5)});
    engine.bodies().add(scenes::disc(1, 0.0, -0.52));
    engine.bodies().add(scenes::polygon(shapes, 1, 2, 3.0, -0.52, std::sqrt(0.5)));
    engine.step(dt);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(engine.bodies().mass[i] * engine.bodies().twist[i].velocity[1], c * dt, 1e-13);
}

EngineSettings filmed(double viscosity) {
    EngineSettings settings = scenes::exact_in_space(0.0, 1e-10);
    settings.gravity = {};
    settings.law.film = "lubrication";
    settings.law_settings.viscosity = viscosity;
    settings.law_settings.film_cutoff = 0.1;
    settings.law_settings.film_roughness = 1e-3;
    return settings;
}

Wall floor_part(std::int32_t key, double x1, double x2, double z1, double z2) {
    return scenes::rectangle(key, {0.5 * (x1 + x2), 0, 0.5 * (z1 + z2)}, {0, 1, 0}, {1, 0, 0},
                             0.5 * (x2 - x1), 0.5 * (z2 - z1));
}

/// A sphere that comes down on a floor of rectangles: its velocity later on.
Vec3 velocity_above(const std::vector<Wall>& walls, const Vec3& place, EngineSettings settings,
                    double speed, double time) {
    Engine engine(settings, scenes::spheres, walls);
    engine.bodies().add(scenes::sphere(1, place));
    engine.bodies().twist[0].velocity = {0.0, -speed, 0.0};
    scenes::run(engine, time, 1e-3);
    return engine.bodies().twist[0].velocity;
}

// Over the edge of two rectangles, and the corner of four.
TEST(CommonEdges, FilmsOfJoinedRectanglesAreThatOfOne) {
    const std::vector<std::vector<Wall>> floors = {
        {floor_part(1, -5, 0, -5, 5), floor_part(2, 0, 5, -5, 5)},
        {floor_part(1, -5, 0, -5, 0), floor_part(2, 0, 5, -5, 0), floor_part(3, -5, 0, 0, 5),
         floor_part(4, 0, 5, 0, 5)}};
    for (const double x : {0.0, 0.02, -0.05, 1.0})
        for (const double z : {0.0, 0.01}) {
            const Vec3 place{x, 0.53, z};
            const Vec3 one =
                velocity_above({floor_part(1, -5, 5, -5, 5)}, place, filmed(0.2), 0.1, 0.1);
            EXPECT_GT(one[1], -0.09) << "the film slows it";
            for (const auto& floor : floors)
                EXPECT_LT(norm(velocity_above(floor, place, filmed(0.2), 0.1, 0.1) - one), 1e-10)
                    << x << " " << z;
        }
}

// The edge that has no film of its own knows in an impact what the film has taken.
TEST(CommonEdges, AReboundAtAJointIsThatOfOneFloor) {
    EngineSettings settings = filmed(0.008);
    Surface elastic;
    elastic.friction = 0.0;
    elastic.restitution = 0.9;
    settings.surfaces = {elastic};
    for (const double x : {0.0, 1e-9}) {
        const Vec3 place{x, 0.55, 0.0};
        const Vec3 one = velocity_above({floor_part(1, -5, 5, -5, 5)}, place, settings, 1.0, 0.1);
        EXPECT_GT(one[1], 0.1);
        EXPECT_LT(one[1], 0.85);
        const Vec3 two = velocity_above({floor_part(1, -5, 0, -5, 5), floor_part(2, 0, 5, -5, 5)},
                                        place, settings, 1.0, 0.1);
        EXPECT_LT(norm(two - one), 1e-6) << x;
    }
}

// A sphere goes over the joint of two rectangles, across the corner of four, and from a floor as
// long as the period into its image, as over one floor: it neither rebounds nor slows down.
TEST(CommonEdges, JoinedRectanglesAreOneFloor) {
    EngineSettings settings = scenes::exact_in_space(0.0, 1e-13);
    Surface elastic;
    elastic.friction = 0.0;
    elastic.restitution = 0.5;
    settings.surfaces = {elastic};
    const auto places = [&](std::vector<Wall> walls, double period) {
        EngineSettings own = settings;
        own.box.length = {period, 0.0, 0.0};
        Engine engine(own, scenes::spheres, walls);
        engine.bodies().add(scenes::sphere(1, {-1.0, 0.5, -0.3}));
        engine.bodies().twist[0].velocity = {3.0, 0.0, 0.9};
        for (int n = 0; n < 80; ++n) {
            engine.step(0.01);
            EXPECT_EQ(engine.points().size(), 1u) << n;
            engine.move(0.01);
        }
        return engine.bodies().position[0];
    };
    const Vec3 end = places({floor_part(1, -5, 5, -5, 5)}, 0.0);
    EXPECT_LT(norm(end - Vec3{1.4, 0.5, 0.42}), 1e-12);
    for (const auto& floor : std::vector<std::vector<Wall>>{
             {floor_part(1, -5, 0.013, -5, 5), floor_part(2, 0.013, 5, -5, 5)},
             {floor_part(1, -5, 0, -5, 0), floor_part(2, 0, 5, -5, 0), floor_part(3, -5, 0, 0, 5),
              floor_part(4, 0, 5, 0, 5)}})
        EXPECT_LT(norm(places(floor, 0.0) - end), 1e-12);
    EXPECT_LT(norm(places({floor_part(1, -3.6, 0.4, -5, 5)}, 4.0) - end), 1e-12);
}

// A sphere rolls from the floor of the box onto a ramp that begins there: what is left of its speed
// is that along the ramp, with restitution as without, however far it was from the foot a step
// before.
TEST(CommonEdges, ARampOnTheFloorHasNoEdge) {
    const double kink = std::numbers::pi / 9.0;
    const Vec3 along{std::cos(kink), std::sin(kink), 0.0};
    const Wall ramp =
        scenes::rectangle(2, 2.5 * along, {-along[1], along[0], 0.0}, along, 2.5, 5.0);
    for (const double start : {-1.0, -0.997, -1.007, -1.013}) {
        Engine engine(scenes::exact_in_space(0.0, 1e-13), scenes::spheres,
                      {scenes::floor(0.0), ramp});
        engine.bodies().add(scenes::sphere(1, {start, 0.5, 0.3}));
        engine.bodies().twist[0].velocity = {3.0, 0.0, 0.0};
        int at_edge = 0;
        for (int n = 0; n < 50; ++n) {
            engine.step(0.01);
            // Beside the foot the floor alone, or the faces of both.
            for (const ContactPoint& point : engine.points())
                at_edge += point.wall == 1 && point.feature != 0;
            engine.move(0.01);
        }
        EXPECT_EQ(at_edge, 0);
        const Vec3 u = engine.bodies().twist[0].velocity;
        const double height = engine.bodies().position[0][1] - 0.5;
        EXPECT_GT(height, 0.1);
        EXPECT_NEAR(0.5 * dot(u, u) + height, 0.5 * std::pow(3.0 * std::cos(kink), 2), 0.05);
    }
}

}  // namespace
}  // namespace turbidite::nscd
