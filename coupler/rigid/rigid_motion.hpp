// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// How a rigid body moves: its rates, and where they take it. Valid C++17.
#pragma once

#include "coupler/rigid/rotation.hpp"

namespace turbidite {

/// Velocity of the centre, or of a pivot, and spin.
struct Twist {
    Vec3 velocity{};  ///< [m/s]
    Vec3 spin{};      ///< [rad/s]

    /// v + omega x r, of the body's point at the end of an arm from the centre [m/s].
    Vec3 at(const Vec3& arm) const { return velocity + cross(spin, arm); }
    bool at_rest() const { return velocity == Vec3{} && spin == Vec3{}; }
    friend bool operator==(const Twist& a, const Twist& b) {
        return a.velocity == b.velocity && a.spin == b.spin;
    }
};

/// Of a message that has both (GrainState, Kick, FreeResponse).
template <class Record>
Twist twist_of(const Record& record) {
    return {record.velocity, record.angular_velocity};
}

/// What of it is in the plane.
inline Twist in_plane(const Twist& twist) {
    return {{twist.velocity[0], twist.velocity[1], 0.0}, {0.0, 0.0, twist.spin[2]}};
}

/// Displacement of the centre, or of a pivot, and the rotation about it.
struct Shift {
    Vec3 displacement{};  ///< [m]
    Vec3 angle{};         ///< rotation vector [rad]
};

inline Shift operator+(const Shift& a, const Shift& b) {
    return {a.displacement + b.displacement, a.angle + b.angle};
}
inline Shift operator*(double factor, const Shift& shift) {
    return {factor * shift.displacement, factor * shift.angle};
}
/// At constant rates over a time.
inline Shift operator*(double time, const Twist& twist) {
    return {time * twist.velocity, time * twist.spin};
}

}  // namespace turbidite
