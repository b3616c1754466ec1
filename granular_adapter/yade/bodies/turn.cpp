// SPDX-License-Identifier: GPL-3.0-or-later
#include "granular_adapter/yade/bodies/turn.hpp"

#include <cmath>

#include "coupler/rigid/rotation.hpp"

namespace turbidite::yade {
namespace {

bool is_identity(const Quaternion& q) {
    return q == Quaternion{1.0, 0.0, 0.0, 0.0};
}

/// The rotation about z; the rest is rounding of YADE's principal axes.
Quaternion in_plane(const Quaternion& q) {
    if (q[1] == 0.0 && q[2] == 0.0) return q;
    const double length = std::hypot(q[0], q[3]);
    return {q[0] / length, 0.0, 0.0, q[3] / length};
}

}  // namespace

Quaternion outline_orientation(const Quaternion& yade, const Turn& turn) {
    if (!turn.planar) return yade;
    // outline = yade * rotation^-1, the inverse of the function below
    return in_plane(is_identity(turn.rotation) ? yade : product(yade, conjugate(turn.rotation)));
}

Quaternion yade_orientation(const Quaternion& outline, const Turn& turn) {
    return is_identity(turn.rotation) ? outline : product(outline, turn.rotation);
}

Vec3 turned_in_plane(const Quaternion& q, const Vec3& v) {
    // (w, 0, 0, z) of length 1: cosine w^2 - z^2, sine 2 w z
    const double c = q[0] * q[0] - q[3] * q[3], s = 2.0 * q[0] * q[3];
    return {c * v[0] - s * v[1], s * v[0] + c * v[1], 0.0};
}

}  // namespace turbidite::yade
