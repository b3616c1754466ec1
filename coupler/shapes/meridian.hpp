// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Surfaces of revolution with a straight meridian: cylinders, truncated cones, plates with a round
// hole. The place of such a surface that is nearest to a point lies in the half-plane of point and
// axis, so its distance is that of (rho, h) from a line segment in that half-plane.
#pragma once

#include <array>
#include <cmath>

namespace turbidite {

/// A place beside an axis, or the difference of two.
struct BesideAxis {
    double radius = 0.0;  ///< distance from the axis, >= 0 [m]
    double height = 0.0;  ///< along it [m]
};

inline BesideAxis operator-(const BesideAxis& p, const BesideAxis& q) {
    return {p.radius - q.radius, p.height - q.height};
}
inline BesideAxis operator*(double factor, const BesideAxis& p) {
    return {factor * p.radius, factor * p.height};
}
inline double dot(const BesideAxis& p, const BesideAxis& q) {
    return p.radius * q.radius + p.height * q.height;
}
inline double norm(const BesideAxis& p) {
    return std::hypot(p.radius, p.height);
}

/// Its two ends; turned about the axis they are the rims of the surface.
using Meridian = std::array<BesideAxis, 2>;

/// The place of a meridian that is nearest to a point of its half-plane.
struct NearestPlace {
    BesideAxis normal{};    ///< unit, from there to the point
    double distance = 0.0;  ///< >= 0 [m]
    int end = -1;           ///< of the meridian, if it is one of them
};

/// Of a meridian longer than zero. A point on it counts as on the side to which the normal
/// (-t_h, t_r) points, t the direction from its first end to its second.
NearestPlace nearest_place(const Meridian& meridian, const BesideAxis& point);

}  // namespace turbidite
