// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Rotations in space, by a unit quaternion q = (w, v) or by a rotation vector, whose direction is
/// the axis and whose length is the angle:
///
///     R(q) = 1 + 2 w [v]x + 2 [v]x [v]x                       quaternion
///     q(a) = (cos |a|/2, sin |a|/2 a/|a|)                     rotation vector a
///     R(a) = cos |a| 1 + sin |a| [e]x + (1 - cos |a|) e e^T   e = a/|a| (Rodrigues)
///
/// In the plane, where only z of v and a is not zero, these are cosine and sine of the angle to the
/// last digit. Valid C++17.
#pragma once

#include "coupler/rigid/vec3.hpp"

namespace turbidite {

/// Body axes to world axes, as rows of the matrix.
struct Rotation {
    Vec3 x{1.0, 0.0, 0.0}, y{0.0, 1.0, 0.0}, z{0.0, 0.0, 1.0};

    Vec3 operator()(const Vec3& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
    /// R^T v
    Vec3 back(const Vec3& v) const { return v[0] * x + v[1] * y + v[2] * z; }
};

/// By a unit quaternion.
inline Rotation rotation(const Quaternion& q) {
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    return {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
            {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
            {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
}

/// By the rotation vector `angle` [rad].
inline Rotation rotation(const Vec3& angle) {
    const double size = norm(angle);
    if (size == 0.0) return {};
    const double c = std::cos(size), s = std::sin(size);
    const Vec3 e = angle / size, se = s * e, te = (1.0 - c) * e;
    return {{c + te[0] * e[0], te[0] * e[1] - se[2], te[0] * e[2] + se[1]},
            {te[1] * e[0] + se[2], c + te[1] * e[1], te[1] * e[2] - se[0]},
            {te[2] * e[0] - se[1], te[2] * e[1] + se[0], c + te[2] * e[2]}};
}

/// Of the angle [rad] about z.
inline Quaternion about_z(double angle) {
    return {std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle)};
}

/// The angle of a rotation about z [rad].
inline double angle_about_z(const Quaternion& q) {
    return 2.0 * std::atan2(q[3], q[0]);
}

/// First q, then p.
inline Quaternion product(const Quaternion& p, const Quaternion& q) {
    return {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
            p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
            p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

/// The inverse of a unit quaternion.
inline Quaternion conjugate(const Quaternion& q) {
    return {q[0], -q[1], -q[2], -q[3]};
}

/// q rotated by the rotation vector `angle` (world axes) [rad]; of length 1 whatever the rounding.
inline Quaternion rotated(const Quaternion& q, const Vec3& angle) {
    const double size = norm(angle);
    if (size == 0.0) return q;
    const Vec3 v = (std::sin(0.5 * size) / size) * angle;
    Quaternion turned = product({std::cos(0.5 * size), v[0], v[1], v[2]}, q);
    const double length = std::sqrt(turned[0] * turned[0] + turned[1] * turned[1] +
                                    turned[2] * turned[2] + turned[3] * turned[3]);
    for (double& component : turned) component /= length;
    return turned;
}

}  // namespace turbidite
