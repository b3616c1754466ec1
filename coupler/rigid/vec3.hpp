// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Vectors and quaternions as the plain numbers that the records hold: no type with alignment
/// requirements appears in an interface, and no header of Eigen in a host that has its own. In the
/// plane z is zero; what the operations add for it changes no digit of x and y. Valid C++17.
#pragma once

#include <array>
#include <cmath>

namespace turbidite {

using Vec3 = std::array<double, 3>;        ///< x, y, z
using Quaternion = std::array<double, 4>;  ///< w, x, y, z; unit

inline Vec3 operator+(const Vec3& a, const Vec3& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vec3 operator-(const Vec3& a, const Vec3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vec3 operator-(const Vec3& a) {
    return {-a[0], -a[1], -a[2]};
}
inline Vec3 operator*(double s, const Vec3& a) {
    return {s * a[0], s * a[1], s * a[2]};
}
inline Vec3 operator/(const Vec3& a, double s) {
    return {a[0] / s, a[1] / s, a[2] / s};
}

inline double dot(const Vec3& a, const Vec3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// (a x b)_z: in the plane, the moment of b at the end of the arm a.
inline double cross_z(const Vec3& a, const Vec3& b) {
    return a[0] * b[1] - a[1] * b[0];
}

/// Its length.
inline double norm(const Vec3& a) {
    return std::sqrt(dot(a, a));
}

inline bool is_finite(const Vec3& a) {
    return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

}  // namespace turbidite
