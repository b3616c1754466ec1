// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/rigid/rigid_motion.hpp"

#include "coupler/rigid/symmetric3.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace turbidite {
namespace {

constexpr double round_off = 1e-15;
const Vec3 some_vector{0.3, -1.2, 0.7};
const Vec3 some_angle{0.4, 1.1, -0.6};

Eigen::Vector3d eigen(const Vec3& v) {
    return {v[0], v[1], v[2]};
}
Eigen::Quaterniond eigen(const Quaternion& q) {
    return {q[0], q[1], q[2], q[3]};
}
Quaternion by(const Vec3& angle) {
    return rotated({1.0, 0.0, 0.0, 0.0}, angle);
}

void expect_near(const Vec3& found, const Eigen::Vector3d& expected) {
    EXPECT_LT((eigen(found) - expected).norm(), 4.0 * round_off);
}

TEST(RigidMotion, RotatesInSpaceAsEigenDoes) {
    const Eigen::AngleAxisd turn(norm(some_angle), eigen(some_angle).normalized());
    expect_near(rotation(some_angle)(some_vector), turn * eigen(some_vector));
    expect_near(rotation(by(some_angle))(some_vector), turn * eigen(some_vector));
    expect_near(rotation(by(some_angle)).back(some_vector), turn.inverse() * eigen(some_vector));
}

TEST(RigidMotion, QuaternionsFollowEachOther) {
    const Quaternion first = by({0.2, -0.1, 0.9}), second = by(some_angle);
    const Eigen::Quaterniond both = eigen(second) * eigen(first);
    EXPECT_LT(eigen(product(second, first)).angularDistance(both), 1e-7);
    EXPECT_LT(eigen(rotated(first, some_angle)).angularDistance(both), 1e-7);
    const Quaternion back = product(second, conjugate(second));
    EXPECT_NEAR(back[0], 1.0, round_off);
    EXPECT_NEAR(back[1], 0.0, round_off);
    EXPECT_NEAR(angle_about_z(about_z(-0.7)), -0.7, round_off);
}

// To the last digit: the plane must not notice the third axis.
TEST(RigidMotion, InThePlaneARotationIsCosineAndSine) {
    const Vec3 v{0.37, -1.21, 0.0};
    for (const double angle : {0.0, 1e-9, 0.3, -0.3, 2.9, -4.1}) {
        const double c = std::cos(angle), s = std::sin(angle);
        const Vec3 expected{c * v[0] - s * v[1], s * v[0] + c * v[1], 0.0};
        EXPECT_EQ(rotation(Vec3{0.0, 0.0, angle})(v), expected) << angle;
        const Quaternion q = about_z(angle);
        const double cosine = 1.0 - 2.0 * q[3] * q[3], sine = 2.0 * q[0] * q[3];
        const Vec3 by_quaternion{cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1], 0.0};
        EXPECT_EQ(rotation(q)(v), by_quaternion) << angle;
    }
}

TEST(Symmetric3, IsTurnedAndInvertedAsAMatrix) {
    Symmetric3 m(2.0);
    m.yy = 3.0, m.zz = 5.0, m.xy = 0.4, m.xz = -0.7, m.yz = 1.1;
    const Rotation r = rotation(some_angle);
    const Symmetric3 world = turned(m, r);
    EXPECT_LT(norm(world * some_vector - r(m * r.back(some_vector))), 1e-14);
    EXPECT_LT(norm(inverse(world) * (world * some_vector) - some_vector), 1e-14);
    EXPECT_TRUE(positive_definite(world));
    m.yz = 4.0;
    EXPECT_FALSE(positive_definite(m));
    EXPECT_FALSE(positive_definite(NAN));
    EXPECT_EQ(inverse(7.0).zz, 1.0 / 7.0);
}

TEST(RigidMotion, APointMovesWithItsBody) {
    const Twist twist{{1.0, 2.0, 3.0}, {0.0, 0.5, -2.0}};
    expect_near(twist.at(some_vector),
                eigen(twist.velocity) + eigen(twist.spin).cross(eigen(some_vector)));
    const double time = 1e-6;
    const Shift way = time * twist;
    const Vec3 moved = way.displacement + rotation(way.angle)(some_vector);
    const Vec3 rate = (moved - some_vector) / time;
    EXPECT_LT(norm(rate - twist.at(some_vector)), 1e-5);
}

}  // namespace
}  // namespace turbidite
