// SPDX-License-Identifier: GPL-3.0-or-later
#include "granular_adapter/yade/turn.hpp"

#include <cmath>

namespace turbidite::yade {
namespace {

Quaternion product(const Quaternion& p, const Quaternion& q) {
    return {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
            p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
            p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

Quaternion conjugate(const Quaternion& q) {
    return {q[0], -q[1], -q[2], -q[3]};
}

bool is_identity(const Quaternion& q) {
    return q == Quaternion{1.0, 0.0, 0.0, 0.0};
}

/// The rotation about z; the rest is rounding of YADE's principal axes.
Quaternion about_z(const Quaternion& q) {
    if (q[1] == 0.0 && q[2] == 0.0) return q;
    const double length = std::hypot(q[0], q[3]);
    return {q[0] / length, 0.0, 0.0, q[3] / length};
}

}  // namespace

Quaternion outline_orientation(const Quaternion& yade, const Turn& turn) {
    if (!turn.planar) return yade;
    return about_z(is_identity(turn.rotation) ? yade : product(yade, conjugate(turn.rotation)));
}

Quaternion yade_orientation(const Quaternion& outline, const Turn& turn) {
    return is_identity(turn.rotation) ? outline : product(outline, turn.rotation);
}

Vec3 turned_in_plane(const Quaternion& q, const Vec3& v) {
    const double c = q[0] * q[0] - q[3] * q[3], s = 2.0 * q[0] * q[3];
    return {c * v[0] - s * v[1], s * v[0] + c * v[1], 0.0};
}

}  // namespace turbidite::yade
