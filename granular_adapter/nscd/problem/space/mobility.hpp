// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The mobility of a sphere: an impulse changes (U, omega) by (J/m, K/I), the same in every
// direction. A sphere with tied fluid has another m and another I.
#pragma once

#include "coupler/rigid/rigid_motion.hpp"

namespace turbidite::nscd {

/// diag(1/m, 1/I); zero for an immovable body [1/kg, 1/(kg m2)].
struct SpaceMobility {
    double linear = 0.0, angular = 0.0;
};

inline bool is_immovable(const SpaceMobility& body) {
    return body.linear == 0.0 && body.angular == 0.0;
}

/// Adds the change of velocity by an impulse p at the end of `arm`. The moments of contacts in
/// space are vectors, not the number `roll` of the plane.
inline void push(Twist& twist, const SpaceMobility& body, const Vec3& arm, const Vec3& p,
                 double /*roll*/) {
    twist.velocity = twist.velocity + body.linear * p;
    twist.spin = twist.spin + body.angular * cross(arm, p);
}

/// The same by a moment impulse.
inline void turn(Twist& twist, const SpaceMobility& body, const Vec3& moment) {
    twist.spin = twist.spin + body.angular * moment;
}

}  // namespace turbidite::nscd
