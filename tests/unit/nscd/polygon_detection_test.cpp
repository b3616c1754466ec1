// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <set>

#include "coupler/rigid/vec3.hpp"
#include "polygon_reference.hpp"
#include "polygons.hpp"

namespace turbidite::nscd {
namespace {

using scenes::between;

constexpr double everything = 1e3;  // alert distance for which all points are reported

ShapeTable squares() {
    return {scenes::square_record()};
}

Bodies two_squares(double x, double y, double angle = 0.0) {
    Bodies bodies;
    bodies.add(scenes::unit_square(squares(), 1, 0.0, 0.0));
    bodies.add(scenes::unit_square(squares(), 2, x, y, angle));
    return bodies;
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-14) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], tolerance);
}

std::set<int> features(const std::vector<ContactPoint>& points) {
    std::set<int> result;
    for (const ContactPoint& point : points) result.insert(point.feature);
    return result;
}

/// Two random polygons, the second at a random place around the first.
struct RandomPair {
    ShapeTable shapes;
    Bodies bodies;

    explicit RandomPair(std::mt19937_64& random) {
        std::uniform_real_distribution<double> turn(0.0, 2.0 * std::numbers::pi), size(0.3, 2.0),
            share(0.0, 1.3);
        shapes = {scenes::random_polygon(random), scenes::random_polygon(random)};
        const double ra = size(random), rb = size(random), where = turn(random);
        const double away = share(random) * (ra + rb);
        bodies.add(scenes::polygon(shapes, 0, 7, 3.0, -2.0, ra, turn(random)));
        bodies.add(scenes::polygon(shapes, 1, 9, 3.0 + away * std::cos(where),
                                   -2.0 + away * std::sin(where), rb, turn(random)));
    }

    reference::Outline outline(int body) const {
        const PolygonShapes table(shapes);
        return reference::outline(PlacedPolygons(table, bodies)[body], bodies.position[body]);
    }
    long double gap() const { return reference::gap(outline(0), outline(1)); }
};

// The smallest gap of the manifold is the distance; for overlapping polygons, minus the smallest
// separating displacement. Ties between sides are decided within 1e-9 of the radii, hence 1e-8.
TEST(PolygonDetection, AgreesWithExhaustion) {
    std::mt19937_64 random(5);
    int apart = 0, overlapping = 0, by_corners = 0;
    for (int n = 0; n < 40000; ++n) {
        const RandomPair pair(random);
        const long double expected = pair.gap();
        const auto points = between(pair.shapes, pair.bodies, 0, 1, everything);
        ASSERT_FALSE(points.empty());
        double least = points[0].gap;
        for (const ContactPoint& point : points) least = std::min(least, point.gap);
        ASSERT_NEAR(least, static_cast<double>(expected), 1e-8) << "pair " << n;
        (expected > 0.0L ? apart : overlapping) += 1;
        const auto near = between(pair.shapes, pair.bodies, 0, 1, 0.2);
        ASSERT_EQ(near.empty(), expected >= 0.2L) << "pair " << n;
        for (const ContactPoint& point : near) ASSERT_LT(point.gap, 0.2);
        by_corners += expected > 0.0L && points.size() == 1;
    }
    EXPECT_GT(apart, 10000);
    EXPECT_GT(overlapping, 10000);
    EXPECT_GT(by_corners, 1000);
}

/// The point of the surface of `body` at the contact: half a gap from the contact point along the
/// normal.
reference::Point surface_point(const RandomPair& pair, const ContactPoint& point, int body) {
    const Vec3 arm = body == 0 ? point.arm_a - 0.5 * point.gap * point.normal
                               : point.arm_b + 0.5 * point.gap * point.normal;
    const Vec3 x = pair.bodies.position[static_cast<std::size_t>(body)] + arm;
    return {x[0], x[1]};
}

// Both arms end at the same point, so that an impulse and its reaction have no net moment, and the
// two surfaces are half a gap away on either side.
TEST(PolygonDetection, ArmsMeetBetweenTheSurfaces) {
    std::mt19937_64 random(6);
    for (int n = 0; n < 20000; ++n) {
        const RandomPair pair(random);
        const Vec3 offset = pair.bodies.position[1] - pair.bodies.position[0];
        for (const ContactPoint& point : between(pair.shapes, pair.bodies, 0, 1, everything)) {
            expect_near(point.arm_a, offset + point.arm_b, 1e-14);
            ASSERT_NEAR(norm(point.normal), 1.0, 1e-14);
            for (const int body : {0, 1}) {
                const auto at = surface_point(pair, point, body);
                ASSERT_LT(reference::to_sides(pair.outline(body), at), 2e-9L) << "pair " << n;
            }
        }
    }
}

void expect_mirrored(const std::vector<ContactPoint>& points,
                     const std::vector<ContactPoint>& swapped) {
    ASSERT_EQ(points.size(), swapped.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
        EXPECT_EQ(points[k].gap, swapped[k].gap);
        EXPECT_EQ(points[k].feature, swapped[k].feature);
        EXPECT_EQ(points[k].length, swapped[k].length);
        for (int axis = 0; axis < 2; ++axis) {
            EXPECT_EQ(points[k].normal[axis], -swapped[k].normal[axis]);
            EXPECT_EQ(points[k].arm_a[axis], swapped[k].arm_b[axis]);
            EXPECT_EQ(points[k].arm_b[axis], swapped[k].arm_a[axis]);
        }
    }
}

// Bit for bit, discs included.
TEST(PolygonDetection, DoesNotDependOnTheOrderOfThePair) {
    std::mt19937_64 random(7);
    for (int n = 0; n < 2000; ++n) {
        RandomPair pair(random);
        if (n % 3 == 0) pair.shapes[0] = {"disc", {}};
        expect_mirrored(between(pair.shapes, pair.bodies, 0, 1, 0.5),
                        between(pair.shapes, pair.bodies, 1, 0, 0.5));
    }
}

/// The pair rotated about the origin.
RandomPair turned(RandomPair pair, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    for (std::size_t i = 0; i < 2; ++i) {
        const Vec3 x = pair.bodies.position[i];
        const Quaternion q = pair.bodies.orientation[i], by = scenes::turned(angle);
        pair.bodies.position[i] = {c * x[0] - s * x[1], s * x[0] + c * x[1], 0.0};
        pair.bodies.orientation[i] = {by[0] * q[0] - by[3] * q[3], 0.0, 0.0,
                                      by[0] * q[3] + by[3] * q[0]};
    }
    return pair;
}

TEST(PolygonDetection, TurnsWithTheBodies) {
    std::mt19937_64 random(8);
    for (int n = 0; n < 5000; ++n) {
        const RandomPair pair(random);
        const double angle = 0.001 * n, c = std::cos(angle), s = std::sin(angle);
        const RandomPair other = turned(pair, angle);
        const auto points = between(pair.shapes, pair.bodies, 0, 1, 0.5);
        const auto there = between(other.shapes, other.bodies, 0, 1, 0.5);
        ASSERT_EQ(points.size(), there.size()) << "pair " << n;
        for (std::size_t k = 0; k < points.size(); ++k) {
            const Vec3& a = points[k].normal;
            EXPECT_EQ(points[k].feature, there[k].feature) << "pair " << n;
            EXPECT_NEAR(points[k].gap, there[k].gap, 1e-13);
            expect_near({c * a[0] - s * a[1], s * a[0] + c * a[1], 0.0}, there[k].normal, 1e-10);
        }
    }
}

// Unit squares, the upper one 0.01 above and 0.3 to the right: their sides overlap by 0.7, from x =
// -0.2 (corner of the upper square) to 0.5 (corner of the lower); relative to the lower centre, the
// points are half-way across the gap at y = 0.505.
TEST(PolygonDetection, PutsTwoPointsOnSharedSides) {
    const Bodies bodies = two_squares(0.3, 1.01);
    const auto points = between(squares(), bodies, 0, 1, 0.05);
    ASSERT_EQ(points.size(), 2u);
    std::vector<double> places;
    for (const ContactPoint& point : points) {
        EXPECT_NEAR(point.gap, 0.01, 1e-14);
        EXPECT_NEAR(point.length, 0.35, 1e-14);
        expect_near(point.normal, {0.0, 1.0, 0.0});
        EXPECT_NEAR(point.arm_a[1], 0.505, 1e-14);
        places.push_back(point.arm_a[0]);
    }
    std::sort(places.begin(), places.end());
    EXPECT_NEAR(places[0], -0.2, 1e-14);
    EXPECT_NEAR(places[1], 0.5, 1e-14);
}

// Rotated by 45 degrees with its corner 0.02 above the side: one point without length.
TEST(PolygonDetection, PutsOnePointUnderACorner) {
    const Bodies bodies = two_squares(0.1, 0.5 + 0.02 + std::sqrt(0.5), std::numbers::pi / 4.0);
    const auto points = between(squares(), bodies, 0, 1, 0.1);
    ASSERT_EQ(points.size(), 1u);
    EXPECT_NEAR(points[0].gap, 0.02, 1e-14);
    EXPECT_EQ(points[0].length, 0.0);
    expect_near(points[0].arm_a, {0.1, 0.51, 0.0});
}

// Corners (0.5, 0.5) and (0.53, 0.54): distance 0.05, normal (0.6, 0.8).
TEST(PolygonDetection, JoinsTwoCornersByALine) {
    const auto points = between(squares(), two_squares(1.03, 1.04), 0, 1, 0.1);
    ASSERT_EQ(points.size(), 1u);
    EXPECT_NEAR(points[0].gap, 0.05, 1e-14);
    expect_near(points[0].normal, {0.6, 0.8, 0.0});
    expect_near(points[0].arm_a, {0.515, 0.52, 0.0});
}

TEST(PolygonDetection, SeparatesCoincidentBodies) {
    for (const double angle : {0.0, 0.3, 0.7853981633974483}) {
        const auto points = between(squares(), two_squares(0.0, 0.0, angle), 0, 1, 0.01);
        ASSERT_FALSE(points.empty());
        EXPECT_NEAR(norm(points[0].normal), 1.0, 1e-14);
        const double expected = 0.5 + std::sqrt(0.5) * std::cos(std::numbers::pi / 4.0 - angle);
        EXPECT_NEAR(points[0].gap, -expected, 1e-14);
    }
}

// Rounding decides which of two sides that lie flat on each other is the reference; names, gaps and
// normals stay.
TEST(PolygonDetection, NamesStayWhenTheReferenceChanges) {
    const auto expected = between(squares(), two_squares(0.3, 1.0), 0, 1, 0.05);
    ASSERT_EQ(expected.size(), 2u);
    for (const double tilt : {-1e-5, -1e-8, -1e-12, -1e-16, 1e-16, 1e-12, 1e-8, 1e-5})
        for (const double rise : {-1e-6, 0.0, 1e-6}) {
            const auto points = between(squares(), two_squares(0.3, 1.0 + rise, tilt), 0, 1, 0.05);
            ASSERT_EQ(points.size(), 2u);
            EXPECT_EQ(features(points), features(expected));
            for (const ContactPoint& point : points) {
                EXPECT_NEAR(point.gap, rise, 1.1e-5);
                expect_near(point.normal, {0.0, 1.0, 0.0}, 1.1e-5);
            }
        }
}

// Squares stacked exactly: rounding decides whether corners are above a side or beyond it, and both
// points must exist in either case.
TEST(PolygonDetection, KeepsBothPointsOfAlignedSides) {
    for (const double shift : {-1e-13, -1e-16, 0.0, 1e-16, 1e-13})
        for (const double gap : {-1e-6, 0.0, 1e-16, 1e-6})
            for (const double tilt : {-1e-9, 0.0, 1e-9}) {
                const auto points =
                    between(squares(), two_squares(shift, 1.0 + gap, tilt), 0, 1, 0.05);
                ASSERT_EQ(points.size(), 2u) << shift << " " << gap << " " << tilt;
                EXPECT_NEAR(std::abs(points[0].arm_a[0] - points[1].arm_a[0]), 1.0, 1e-8);
                for (const ContactPoint& point : points)
                    expect_near(point.normal, {0.0, 1.0, 0.0}, 1e-5);
            }
}

// Sides with common ends: whichever corner is the inner one by rounding, the names stay, and the
// two points have different names.
TEST(PolygonDetection, NamesStayWhereCornersMeet) {
    const auto expected = features(between(squares(), two_squares(0.0, 1.0), 0, 1, 0.05));
    ASSERT_EQ(expected.size(), 2u);
    for (const double shift : {-1e-3, -1e-6, -1e-12, 1e-12, 1e-6, 1e-3})
        for (const double tilt : {-1e-6, 0.0, 1e-6}) {
            const auto points = between(squares(), two_squares(shift, 1.0, tilt), 0, 1, 0.05);
            EXPECT_EQ(features(points), expected) << shift << " " << tilt;
        }
}

// An overlap of sides so short that both of its ends are at the same corner: two points, two names.
TEST(PolygonDetection, NamesDifferOnShortCommonParts) {
    for (const double shared : {1e-6, 1e-4, 1e-3, 5e-3, 2e-2})
        for (const double side : {-1.0, 1.0})
            for (const double tilt : {-1e-4, -1e-9, 0.0, 1e-9, 1e-4})
                for (const double rise : {-1e-5, 0.0, 1e-5}) {
                    const auto points =
                        between(squares(), two_squares(side * (1.0 - shared), 1.0 + rise, tilt), 0,
                                1, 0.05);
                    EXPECT_EQ(features(points).size(), points.size())
                        << shared << " " << side << " " << tilt << " " << rise;
                }
}

// If a body moves by less than d, the smallest gap changes by less than d.
TEST(PolygonDetection, GapIsContinuous) {
    std::mt19937_64 random(9);
    for (int n = 0; n < 300; ++n) {
        RandomPair pair(random);
        const Vec3 towards = pair.bodies.position[0] - pair.bodies.position[1];
        double before = between(pair.shapes, pair.bodies, 0, 1, everything)[0].gap;
        for (int step = 0; step < 100; ++step) {
            pair.bodies.position[1] = pair.bodies.position[1] + 0.01 * towards;
            const auto points = between(pair.shapes, pair.bodies, 0, 1, everything);
            double least = points[0].gap;
            for (const ContactPoint& point : points) least = std::min(least, point.gap);
            ASSERT_LE(std::abs(least - before), 0.01 * norm(towards) + 1e-8);
            before = least;
        }
    }
}

// Of polygons and discs among each other and at walls.
TEST(PolygonDetection, ThreadsFindTheSamePointsInTheSameOrder) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> place(0.0, 60.0), turn(0.0, 2.0 * std::numbers::pi);
    const ShapeTable shapes = {
        scenes::random_polygon(random), {"disc", {}}, scenes::square_record()};
    Bodies bodies;
    for (int i = 0; i < 4000; ++i)
        bodies.add(
            scenes::polygon(shapes, i % 3, i, place(random), place(random), 0.5, turn(random)));
    const std::vector<Wall> walls = {scenes::floor(0.3)};
    const auto found = [&](int threads) {
        return Detection(shapes, {}, ContactOrder::top_down, threads)
            .points(bodies, walls, {0.0, -1.0, 0.0}, 0.02, 0.02);
    };
    const std::vector<ContactPoint> one = found(1), several = found(3);
    EXPECT_GT(one.size(), 4000u);
    EXPECT_GT(std::count_if(one.begin(), one.end(), [](const auto& p) { return p.wall >= 0; }), 30);
    ASSERT_EQ(several.size(), one.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
        const ContactPoint &p = several[k], &q = one[k];
        ASSERT_EQ(std::tie(p.a, p.b, p.wall, p.feature, p.gap, p.normal),
                  std::tie(q.a, q.b, q.wall, q.feature, q.gap, q.normal));
    }
}

TEST(DiscPolygonDetection, AgreesWithExhaustion) {
    std::mt19937_64 random(10);
    int corners = 0;
    for (int n = 0; n < 20000; ++n) {
        RandomPair pair(random);
        const reference::Outline polygon = pair.outline(1);
        pair.shapes[0] = {"disc", {}};
        const Vec3& x = pair.bodies.position[0];
        const reference::Point centre{x[0], x[1]};
        const long double height = reference::separation(polygon, {centre});
        const long double away = height > 0.0L ? reference::to_sides(polygon, centre) : height;
        const auto points = between(pair.shapes, pair.bodies, 0, 1, everything);
        ASSERT_EQ(points.size(), 1u);
        const ContactPoint& point = points[0];
        EXPECT_NEAR(point.gap, static_cast<double>(away) - pair.bodies.radius[0], 1e-13);
        expect_near(point.arm_a, pair.bodies.position[1] - x + point.arm_b, 1e-14);
        expect_near(point.arm_a, (pair.bodies.radius[0] + 0.5 * point.gap) * point.normal, 1e-14);
        corners += point.feature % 2;
    }
    EXPECT_GT(corners, 1000);
}

}  // namespace
}  // namespace turbidite::nscd
