// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Plates that continue each other are one floor (detection/plane/plate_joints.hpp).
#include <gtest/gtest.h>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/detection/detection.hpp"
#include "polygons.hpp"

namespace turbidite::nscd {
namespace {

const ShapeTable squares = {scenes::square_record()};

Wall plate(std::int32_t key, const Vec3& from, const Vec3& to, double thickness) {
    Wall wall = scenes::floor(0.0);
    wall.key = key;
    wall.point = 0.5 * (from + to);
    wall.half_length = 0.5 * norm(to - from);
    wall.half_thickness = 0.5 * thickness;
    const Vec3 along = (1.0 / norm(to - from)) * (to - from);
    wall.normal = {-along[1], along[0], 0.0};
    return wall;
}

struct Slide {
    bool square;
    double restitution, friction, thickness;

    friend std::ostream& operator<<(std::ostream& out, const Slide& s) {
        return out << (s.square ? "square" : "disc") << ", e = " << s.restitution
                   << ", mu = " << s.friction << ", thickness " << s.thickness;
    }
};

Engine sliding(const Slide& slide, const std::vector<Wall>& walls, double period = 0.0) {
    EngineSettings settings = scenes::exact(slide.friction, 1e-13);
    settings.gravity = {0.0, -1.0, 0.0};
    Surface surface;
    surface.friction = slide.friction;
    surface.restitution = slide.restitution;
    settings.surfaces = {surface};
    settings.box.length = {period, 0.0, 0.0};
    std::vector<Wall> floors = walls;
    for (Wall& wall : floors) wall.material = 0;
    Engine engine(settings, slide.square ? squares : scenes::discs, floors);
    const double height = 0.5 + 0.5 * slide.thickness;
    engine.bodies().add(slide.square ? scenes::unit_square(squares, 1, -1.5, height)
                                     : scenes::disc(1, -1.5, height));
    engine.bodies().twist[0].velocity = {3.0, 0.0, 0.0};
    return engine;
}

/// Plays both and compares place, direction and velocity after every step. Returns how often plates
/// other than the first had a contact.
int expect_alike(Engine one, Engine other, const Slide& slide, double period = 0.0) {
    int on_others = 0;
    for (int n = 0; n < 100; ++n) {
        one.step(0.01), other.step(0.01);
        for (std::size_t k = 0; k < one.points().size(); ++k)
            on_others += one.points()[k].wall > 0 && one.impulses()[k].n > 0.0;
        one.move(0.01), other.move(0.01);
        const Bodies &a = one.bodies(), &b = other.bodies();
        Vec3 apart = a.position[0] - b.position[0];
        if (period > 0.0) apart[0] -= period * std::round(apart[0] / period);
        EXPECT_LT(norm(apart), 1e-9) << slide << ", step " << n;
        EXPECT_LT(norm(a.twist[0].velocity - b.twist[0].velocity), 1e-8) << slide << ", step " << n;
        EXPECT_LT(norm(a.twist[0].spin - b.twist[0].spin), 1e-8) << slide << ", step " << n;
        if (::testing::Test::HasFailure()) break;
    }
    return on_others;
}

std::vector<Slide> slides() {
    std::vector<Slide> all;
    for (const bool square : {true, false})
        for (const double restitution : {0.0, 0.5})
            for (const double friction : {0.0, 0.3})
                for (const double thickness : {0.0, 0.1})
                    all.push_back({square, restitution, friction, thickness});
    return all;
}

TEST(PlateJoints, TwoPlatesAreOneFloor) {
    for (const Slide& slide : slides()) {
        const Vec3 left{-4, 0, 0}, joint{-0.303, 0, 0}, right{6, 0, 0};
        auto one = sliding(slide, {plate(1, left, right, slide.thickness)});
        // One of them drawn the other way round, with its normal down.
        auto two = sliding(slide, {plate(1, left, joint, slide.thickness),
                                   plate(2, right, joint, slide.thickness)});
        EXPECT_GT(expect_alike(std::move(two), std::move(one), slide), 20) << slide;
    }
}

TEST(PlateJoints, APlateContinuesInItsImage) {
    for (const Slide& slide : slides()) {
        auto one = sliding(slide, {plate(1, {-9, 0, 0}, {9, 0, 0}, slide.thickness)});
        auto cyclic = sliding(slide, {plate(1, {-4.7, 0, 0}, {-0.7, 0, 0}, slide.thickness)}, 4.0);
        EXPECT_GT(expect_alike(std::move(cyclic), std::move(one), slide, 4.0), 20) << slide;
    }
}

// A disc crosses a ridge and a valley of 20 degrees: at the ridge it turns about the common end, in
// the valley it goes from face to face, and nowhere does it lose more than the kink takes.
TEST(PlateJoints, AKinkTakesWhatItsAngleTakes) {
    const double kink = std::numbers::pi / 9.0;
    const Slide slide{false, 0.0, 0.0, 0.0};
    const Vec3 top{5.0 * std::cos(kink), 5.0 * std::sin(kink), 0.0};
    Engine valley =
        sliding(slide, {plate(1, {-4, 0, 0}, {0, 0, 0}, 0.0), plate(2, {0, 0, 0}, top, 0.0)});
    double before = 3.0;
    while (valley.bodies().position[0][0] < 0.1 + 0.5 * std::sin(kink)) {
        valley.step(0.001);
        valley.move(0.001);
        before = norm(valley.bodies().twist[0].velocity);
    }
    // u cos(kink) remains; the climb since takes g y.
    const double height = valley.bodies().position[0][1] - 0.5;
    EXPECT_NEAR(0.5 * before * before, 0.5 * std::pow(3.0 * std::cos(kink), 2) - height, 0.02);
}

// A square that cannot turn slides from a floor, a plate or the bottom of the box, onto a ramp:
// what is left of its speed is that along the ramp.
TEST(PlateJoints, ARampTakesWhatItsAngleTakes) {
    const double kink = std::numbers::pi / 9.0;
    const Vec3 top{5.0 * std::cos(kink), 5.0 * std::sin(kink), 0.0};
    const Wall ramp = plate(2, {0, 0, 0}, top, 0.0);
    for (const Wall& floor : {plate(1, {-4, 0, 0}, {0, 0, 0}, 0.0), scenes::floor(0.0)})
        for (const double start : {-1.5, -1.497, -1.513, -1.505}) {
            Engine engine = sliding({true, 0.0, 0.0, 0.0}, {floor, ramp});
            engine.bodies().rotation_blocked[0] = 1;
            engine.bodies().position[0][0] = start;
            EXPECT_TRUE(scenes::run(engine, 0.6, 0.01));
            const Vec3 u = engine.bodies().twist[0].velocity;
            const double height = engine.bodies().position[0][1] - 0.5;
            EXPECT_GT(height, 0.1) << "on the ramp";
            // (u cos(kink))^2/2 is kept; a step on the way up, g dt, is not resolved.
            EXPECT_NEAR(0.5 * dot(u, u) + height, 0.5 * std::pow(3.0 * std::cos(kink), 2), 0.05)
                << start;
        }
}

// A square in the corner of a floor and a plate that stands on it needs the foot of that plate,
// where the floor leads on in both directions.
TEST(PlateJoints, ASquareLiesInACornerOfPlates) {
    EngineSettings settings = scenes::exact(0.3, 1e-13);
    settings.gravity = {1.0, -1.0, 0.0};
    Engine engine(settings, squares,
                  {plate(1, {-4, 0, 0}, {4, 0, 0}, 0.0), plate(2, {1, 0, 0}, {1, 3, 0}, 0.0)});
    engine.bodies().add(scenes::unit_square(squares, 1, 0.5, 0.5));
    EXPECT_TRUE(scenes::run(engine, 5.0, 0.01));
    EXPECT_LT(norm(engine.bodies().position[0] - Vec3{0.5, 0.5, 0.0}), 1e-9);
    EXPECT_LT(norm(engine.bodies().twist[0].spin), 1e-9);
    EXPECT_LT(engine.max_penetration(), 1e-9);
}

// Where laws act across gaps these points stay: bridges go along by them.
TEST(PlateJoints, WithALawOfARangeTheEndsStay) {
    for (const double range : {0.0, 0.1}) {
        EngineSettings settings = scenes::adhesive(range > 0.0 ? "wet" : "none", range, range);
        Engine engine(settings, scenes::discs,
                      {plate(1, {-4, 0, 0}, {0, 0, 0}, 0.0), plate(2, {0, 0, 0}, {4, 0, 0}, 0.0)});
        engine.bodies().add(scenes::disc(1, -0.01, 0.5));
        engine.step(0.01);
        EXPECT_EQ(engine.points().size(), range > 0.0 ? 2u : 1u);
    }
}

// Of random squares and discs over the joint of two plates, flat or with a kink: the points that
// are left out are at the joint, and the body comes nearer elsewhere or meets the joint by another
// one.
TEST(PlateJoints, LeaveOutPointsAtTheJointAlone) {
    const ShapeTable shapes = {scenes::square_record(), {"disc", {}}};
    const Detection detection(shapes, {});
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    int left_out = 0, kept = 0;
    for (int n = 0; n < 20000; ++n) {
        const double kink = n % 2 == 0 ? 0.0 : 0.5 * any(random);
        const std::vector<Wall> walls{
            plate(1, {-2, 0, 0}, {0, 0, 0}, 0.0),
            plate(2, {0, 0, 0}, {2 * std::cos(kink), 2 * std::sin(kink), 0}, 0.0)};
        Bodies bodies;
        const double x = any(random), y = 0.5 + 0.1 * any(random), angle = 0.3 * any(random);
        bodies.add(n % 3 == 0 ? scenes::disc(1, x, y)
                              : scenes::unit_square(shapes, 1, x, y, angle));
        bodies.shape[0] = n % 3 == 0 ? 1 : 0;
        const auto found = [&](bool joined) {
            return detection.ordered_points({bodies, walls, {0, -1, 0}, 0.3, 0.0, joined}).points;
        };
        const auto all = found(false), some = found(true);
        const auto stays = [&](const ContactPoint& point) {
            return std::any_of(some.begin(), some.end(), [&](const ContactPoint& p) {
                return p.wall == point.wall && p.feature == point.feature && p.gap == point.gap;
            });
        };
        const auto is_at_joint = [&](const ContactPoint& p) {
            return norm(bodies.position[0] + p.arm_b - p.gap * p.normal) < 1e-9;
        };
        for (const ContactPoint& point : all) {
            kept += stays(point), left_out += !stays(point);
            if (stays(point)) continue;
            EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const ContactPoint& p) {
                return p.wall == point.wall && is_at_joint(p) && !stays(p);
            })) << n;
            EXPECT_TRUE(std::any_of(some.begin(), some.end(), [&](const ContactPoint& p) {
                return p.gap <= point.gap + 1e-12;
            })) << n;
        }
    }
    EXPECT_GT(left_out, 1000);
    EXPECT_GT(kept, 10000);
}

}  // namespace
}  // namespace turbidite::nscd
