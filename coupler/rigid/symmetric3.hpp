// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Symmetric 3 x 3 matrices: moments of inertia and their inverses. Valid C++17.
#pragma once

#include "coupler/rigid/rotation.hpp"

namespace turbidite {

/// The six entries of a symmetric matrix.
struct Symmetric3 {
    double xx = 0.0, yy = 0.0, zz = 0.0;
    double xy = 0.0, xz = 0.0, yz = 0.0;

    Symmetric3() = default;
    /// The same about every axis.
    Symmetric3(double value) : xx(value), yy(value), zz(value) {}

    bool isotropic() const { return xx == yy && yy == zz && xy == 0.0 && xz == 0.0 && yz == 0.0; }

    friend Vec3 operator*(const Symmetric3& m, const Vec3& v) {
        return {m.xx * v[0] + m.xy * v[1] + m.xz * v[2], m.xy * v[0] + m.yy * v[1] + m.yz * v[2],
                m.xz * v[0] + m.yz * v[1] + m.zz * v[2]};
    }
    friend Symmetric3 operator*(double factor, Symmetric3 m) {
        for (double* entry : {&m.xx, &m.yy, &m.zz, &m.xy, &m.xz, &m.yz}) *entry *= factor;
        return m;
    }
};

/// Sylvester's criterion; false for NaN.
inline bool positive_definite(const Symmetric3& m) {
    const double second = m.xx * m.yy - m.xy * m.xy;
    const Vec3 last = cross({m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz});
    return m.xx > 0.0 && second > 0.0 && dot(last, {m.xz, m.yz, m.zz}) > 0.0;
}

/// By cofactors; one over the value where it is isotropic.
inline Symmetric3 inverse(const Symmetric3& m) {
    if (m.isotropic()) return 1.0 / m.xx;
    Symmetric3 result;
    result.xx = m.yy * m.zz - m.yz * m.yz;
    result.yy = m.xx * m.zz - m.xz * m.xz;
    result.zz = m.xx * m.yy - m.xy * m.xy;
    result.xy = m.xz * m.yz - m.xy * m.zz;
    result.xz = m.xy * m.yz - m.xz * m.yy;
    result.yz = m.xy * m.xz - m.xx * m.yz;
    return (1.0 / (m.xx * result.xx + m.xy * result.xy + m.xz * result.xz)) * result;
}

/// R M R^T: from body axes to world axes.
inline Symmetric3 turned(const Symmetric3& m, const Rotation& r) {
    const Vec3 x = m * r.x, y = m * r.y, z = m * r.z;
    Symmetric3 result;
    result.xx = dot(r.x, x), result.yy = dot(r.y, y), result.zz = dot(r.z, z);
    result.xy = dot(r.x, y), result.xz = dot(r.x, z), result.yz = dot(r.y, z);
    return result;
}

}  // namespace turbidite
