// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Impulses on a rigid body. Valid C++17.
#pragma once

#include "coupler/rigid/vec3.hpp"

namespace turbidite {

/// Of forces on a body over a time, and of their moments about its centre; also a momentum.
struct Impulse {
    Vec3 linear{};  ///< [N s]; per unit length in the plane
    Vec3 moment{};  ///< [N s m]; the same

    Impulse& operator+=(const Impulse& other) {
        linear = linear + other.linear;
        moment = moment + other.moment;
        return *this;
    }
};

inline Impulse operator+(Impulse a, const Impulse& b) {
    return a += b;
}
inline Impulse operator-(const Impulse& a, const Impulse& b) {
    return {a.linear - b.linear, a.moment - b.moment};
}

/// Of a momentum that does not change: its rounding, some 1e-16 to 1e-14 of it, is no defect of a
/// balance whose terms are all rounding.
constexpr double beyond_rounding = 1e-7;

}  // namespace turbidite
