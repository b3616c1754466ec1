// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rotation between the axes of a Polyhedra in YADE, which are principal axes, and those of the
// outline, in which its vertices were given. Both rotate about z only:
//
//     yade = outline * turn.rotation
#pragma once

#include "coupler/protocol/records.hpp"

namespace turbidite::yade {

struct Turn {
    /// An outline, for which only the rotation about z counts; false for discs.
    bool planar = false;
    Quaternion rotation{1.0, 0.0, 0.0, 0.0};
};

Quaternion outline_orientation(const Quaternion& yade, const Turn& turn);
Quaternion yade_orientation(const Quaternion& outline, const Turn& turn);

/// `v` in the plane, rotated by the angle of `q` about z.
Vec3 turned_in_plane(const Quaternion& q, const Vec3& v);

}  // namespace turbidite::yade
