// SPDX-License-Identifier: GPL-3.0-or-later
//
// YADE gives a Polyhedra its principal axes; an outline has the axes in which its vertices were
// given. Both rotate about z only:
//
//     yade = outline * turn.rotation
#pragma once

#include "coupler/protocol/records.hpp"

namespace turbidite::yade {

struct Turn {
    bool planar = false;  ///< an outline: only its rotation about z counts; discs have none
    Quaternion rotation{1.0, 0.0, 0.0, 0.0};
};

Quaternion outline_orientation(const Quaternion& yade, const Turn& turn);
Quaternion yade_orientation(const Quaternion& outline, const Turn& turn);

/// `v` of the plane, rotated by the angle of `q` about z.
Vec3 turned_in_plane(const Quaternion& q, const Vec3& v);

}  // namespace turbidite::yade
