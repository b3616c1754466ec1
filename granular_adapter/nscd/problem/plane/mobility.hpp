// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The mobility of a body in the plane: an impulse changes (U, omega) by M^-1 (J, K), where M^-1 is
// any symmetric matrix over (x, y, spin). A dry body has diag(1/m, 1/m, 1/I); one with tied fluid
// has a full matrix.
#pragma once

#include <optional>

#include "coupler/rigid/rigid_motion.hpp"

namespace turbidite::nscd {

/// (x, y, spin): an impulse with its moment, or a change of velocity with the change of spin. Three
/// numbers where a Twist has six, since the sweeps compute with nothing else.
struct PlanarVector {
    double x = 0.0, y = 0.0, spin = 0.0;

    friend double dot(const PlanarVector& a, const PlanarVector& b) {
        return a.x * b.x + a.y * b.y + a.spin * b.spin;
    }
};

/// Symmetric, over (x, y, spin).
struct PlanarTensor {
    double xx = 0.0, yy = 0.0, ss = 0.0;
    double xy = 0.0, xs = 0.0, ys = 0.0;

    PlanarTensor() = default;
    /// diag(linear, linear, angular).
    PlanarTensor(double linear, double angular) : xx(linear), yy(linear), ss(angular) {}

    /// diag(a, a, b): the same in all directions, and uncoupled from the spin.
    bool isotropic() const { return xx == yy && uncoupled(); }
    bool uncoupled() const { return xy == 0.0 && xs == 0.0 && ys == 0.0; }

    friend PlanarVector operator*(const PlanarTensor& m, const PlanarVector& v) {
        return {m.xx * v.x + m.xy * v.y + m.xs * v.spin, m.xy * v.x + m.yy * v.y + m.ys * v.spin,
                m.xs * v.x + m.ys * v.y + m.ss * v.spin};
    }
};

/// M^-1; zero for an immovable body [1/kg, 1/(kg m), 1/(kg m2)].
using BodyMobility = PlanarTensor;

inline bool is_immovable(const BodyMobility& body) {
    return body.xx == 0.0 && body.yy == 0.0 && body.ss == 0.0;
}

/// Adds the change of velocity by an impulse p at the end of `arm` and a moment impulse about e_z.
inline void push(Twist& twist, const BodyMobility& body, const Vec3& arm, const Vec3& p,
                 double moment) {
    const PlanarVector change = body * PlanarVector{p[0], p[1], cross_z(arm, p) + moment};
    twist.velocity[0] += change.x;
    twist.velocity[1] += change.y;
    twist.spin[2] += change.spin;
}

/// Empty unless the tensor is positive definite; isotropic tensors stay isotropic.
std::optional<PlanarTensor> inverse(const PlanarTensor& tensor);

}  // namespace turbidite::nscd
