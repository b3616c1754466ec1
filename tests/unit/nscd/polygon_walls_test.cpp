// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "coupler/rigid/vec3.hpp"
#include "polygon_reference.hpp"
#include "polygons.hpp"

namespace turbidite::nscd {
namespace {

const ShapeTable squares = {scenes::square_record()};

Bodies one_square(double x, double y, double angle = 0.0) {
    Bodies bodies;
    bodies.add(scenes::unit_square(squares, 1, x, y, angle));
    return bodies;
}

void expect_near(const Vec3& a, const Vec3& b) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], 1e-14);
}

// A unit square 0.01 above the floor: contact points at both lower corners, with half the side
// each.
TEST(PolygonWall, HoldsASideByItsCorners) {
    const auto points = scenes::at_wall(squares, one_square(3.0, 0.51), scenes::floor(0.0), 0.1);
    ASSERT_EQ(points.size(), 2u);
    EXPECT_NE(points[0].feature, points[1].feature);
    for (const ContactPoint& point : points) {
        EXPECT_NEAR(point.gap, 0.01, 1e-15);
        EXPECT_NEAR(point.length, 0.5, 1e-15);
        EXPECT_NEAR(std::abs(point.arm_b[0]), 0.5, 1e-15);
        EXPECT_NEAR(point.arm_b[1], -0.5, 1e-15);
    }
}

TEST(PolygonWall, HoldsACorner) {
    const double half = std::sqrt(0.5);
    const auto points = scenes::at_wall(squares, one_square(0.0, half - 0.02, std::numbers::pi / 4),
                                        scenes::floor(0.0), 0.1);
    ASSERT_EQ(points.size(), 1u);
    EXPECT_NEAR(points[0].gap, -0.02, 1e-15);
    EXPECT_EQ(points[0].length, 0.0);
    expect_near(points[0].arm_b, {0.0, -half, 0.0});
}

Wall plate(double half_length) {
    Wall wall = scenes::floor(0.0);
    wall.half_length = half_length;
    return wall;
}

// A plate |x| <= 0.2 under a square that spans |x| <= 0.5: contact points at both ends of the
// plate.
TEST(PolygonWall, EndsOfAPlateHoldASide) {
    for (const double side : {1.0, -1.0}) {
        const auto points = scenes::at_wall(squares, one_square(0.1, side * 0.51), plate(0.2), 0.1);
        ASSERT_EQ(points.size(), 2u);
        std::vector<double> places{points[0].arm_b[0], points[1].arm_b[0]};
        std::sort(places.begin(), places.end());
        EXPECT_NEAR(places[0], -0.3, 1e-14);
        EXPECT_NEAR(places[1], 0.1, 1e-14);
        for (const ContactPoint& point : points) {
            EXPECT_NEAR(point.gap, 0.01, 1e-14);
            EXPECT_NEAR(point.length, 0.2, 1e-14);
            expect_near(point.normal, {0.0, side, 0.0});
            EXPECT_NEAR(point.arm_b[1], -side * 0.5, 1e-14);
        }
    }
}

// The end of a plate against a corner: (0.2, 0) and (0.23, 0.04).
TEST(PolygonWall, EndOfAPlateMeetsACorner) {
    const auto points = scenes::at_wall(squares, one_square(0.73, 0.54), plate(0.2), 0.1);
    ASSERT_EQ(points.size(), 1u);
    EXPECT_NEAR(points[0].gap, 0.05, 1e-14);
    expect_near(points[0].normal, {0.6, 0.8, 0.0});
    expect_near(points[0].arm_b, {-0.5, -0.5, 0.0});
}

// A thickness is taken from the gap, beside the plate and around its ends, and changes nothing
// else.
TEST(PolygonWall, APlateWithAThicknessHasRoundEnds) {
    const ShapeTable shapes = {scenes::square_record(), {"disc", {}}};
    Wall thick = plate(0.2);
    thick.half_thickness = 0.03;
    for (const bool disc : {false, true})
        for (const double x : {0.1, 0.66}) {
            Bodies bodies = one_square(x, 0.54);
            if (disc) bodies.shape[0] = 1, bodies.radius[0] = 0.5;
            const auto thin_points = scenes::at_wall(shapes, bodies, plate(0.2), 0.23);
            const auto points = scenes::at_wall(shapes, bodies, thick, 0.2);
            ASSERT_EQ(points.size(), thin_points.size());
            ASSERT_GT(points.size(), 0u);
            for (std::size_t i = 0; i < points.size(); ++i) {
                EXPECT_NEAR(points[i].gap, thin_points[i].gap - 0.03, 1e-15);
                expect_near(points[i].normal, thin_points[i].normal);
                expect_near(points[i].arm_b, thin_points[i].arm_b);
            }
        }
}

// The names of a plate's ends do not depend on the side from which they are touched.
TEST(PolygonWall, EndsOfAPlateKeepTheirNames) {
    const auto feature_at_right = [](double side) {
        const auto points = scenes::at_wall(squares, one_square(0.4, side * 0.51), plate(0.2), 0.1);
        for (const ContactPoint& point : points)
            if (std::abs(0.4 + point.arm_b[0] - 0.2) < 1e-12) return point.feature;
        return -1;
    };
    EXPECT_GE(feature_at_right(1.0), 0);
    EXPECT_EQ(feature_at_right(1.0), feature_at_right(-1.0));
}

// Random polygons around a plate, without overlap: the smallest gap is the distance.
TEST(PolygonWall, PlateAgreesWithExhaustion) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> place(-2.0, 2.0), turn(0.0, 6.2);
    int seen = 0;
    for (int n = 0; n < 5000; ++n) {
        const ShapeTable shapes = {scenes::random_polygon(random)};
        Bodies bodies;
        bodies.add(scenes::polygon(shapes, 0, 1, place(random), place(random), 0.7, turn(random)));
        const Wall wall = plate(1.0);
        const PolygonShapes table(shapes);
        const auto outline =
            reference::outline(PlacedPolygons(table, bodies)[0], bodies.position[0]);
        const reference::Point ends[] = {{-1.0L, 0.0L}, {1.0L, 0.0L}};
        long double least = INFINITY;
        for (const auto& end : ends) least = std::min(least, reference::to_sides(outline, end));
        for (const auto& corner : outline)
            least = std::min(least, reference::to_segment(ends[0], ends[1], corner));
        bool apart = true;  // the polygon does not extend to both sides of the plate
        for (std::size_t k = 0; k < outline.size(); ++k)
            apart = apart && outline[k].y * outline[0].y > 0.0L;
        if (!apart) continue;
        ++seen;
        const auto points = scenes::at_wall(shapes, bodies, wall, 1e3);
        ASSERT_FALSE(points.empty());
        double found = points[0].gap;
        for (const ContactPoint& point : points) found = std::min(found, point.gap);
        EXPECT_NEAR(found, static_cast<double>(least), 1e-8);
    }
    EXPECT_GT(seen, 2000);
}

enum class Under { half_plane, plate, large_square };

/// Adds what lies below y = 0.
void lay(Engine& engine, const ShapeTable& shapes, Under under) {
    if (under != Under::large_square) return;
    Body square = scenes::polygon(shapes, 1, 2, 0.0, -5.0, 5.0 * std::numbers::sqrt2);
    square.fixed = true;
    engine.bodies().add(square);
}

std::vector<Wall> walls_of(Under under) {
    if (under == Under::large_square) return {};
    Wall wall = scenes::floor(0.0);
    if (under == Under::plate) wall.half_length = 5.0;
    return {wall};
}

// A rectangle with a small chamfer at one end of its lower side tips over the chamfer's upper
// corner onto its long side, whose other end closes within the step although both corners of the
// chamfer are lower. So does one whose lower side ends in a blunt corner.
TEST(PolygonContact, AShortSideHidesNoCorner) {
    const auto chamfered = [](double size) {
        return scenes::polygon_record({0, 0, 1 - size, 0, 1, size, 1, 0.5, 0, 0.5});
    };
    const auto blunt = [](double size) {
        return scenes::polygon_record({0, 0, 0.5, 0, 0.5 + size, 0.01 * size, 1,
                                       0.01 * size + 0.02 * (0.5 - size), 1, 0.5, 0, 0.5});
    };
    for (const Under under : {Under::half_plane, Under::plate, Under::large_square}) {
        std::size_t most = 0;
        for (const double size : {0.001, 0.003, 0.01})
            for (const double spin : {0.5, 1.0, 2.0, 4.0, -0.5, -1.0, -2.0, -4.0})
                for (const ShapeRecord& outline : {chamfered(size), blunt(size)}) {
                    const ShapeTable shapes = {outline, scenes::square_record()};
                    Engine engine(scenes::exact(0.0, 1e-12), shapes, walls_of(under));
                    // The circumscribed circle has the shape's size: that of the rectangle, nearly.
                    engine.bodies().add(scenes::polygon(shapes, 0, 1, 0.0, 0.7,
                                                        0.5 * std::hypot(1.0, 0.5),
                                                        spin > 0.0 ? -0.3 : 0.3));
                    engine.bodies().twist[0].spin = {0.0, 0.0, spin};
                    lay(engine, shapes, under);
                    double deepest = 0.0;
                    for (int n = 0; n < 400; ++n) {
                        engine.step(0.01);
                        most = std::max(most, engine.points().size());
                        engine.move(0.01);
                        deepest = std::max(deepest, engine.max_penetration());
                    }
                    EXPECT_LT(deepest, 1e-4) << static_cast<int>(under) << " " << size << " "
                                             << spin << " " << outline.vertices.size();
                }
        EXPECT_GE(most, 3u) << static_cast<int>(under);
    }
}

}  // namespace
}  // namespace turbidite::nscd
