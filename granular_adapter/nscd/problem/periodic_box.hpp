// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Periodic axes, and the minimum image on them.
#pragma once

#include <cmath>

#include "coupler/rigid/vec3.hpp"

namespace turbidite::nscd {

struct PeriodicBox {
    Vec3 lower{};   ///< [m]
    Vec3 length{};  ///< [m]; zero for an axis that is not periodic

    bool repeats(int axis) const { return length[axis] > 0.0; }
    bool repeats() const { return repeats(0) || repeats(1) || repeats(2); }

    /// The shortest periodic image of a distance vector.
    Vec3 minimum_image(Vec3 d) const {
        for (int axis = 0; axis < 3; ++axis)
            // Up to half a period nearbyint() is 0, and costs more than all the rest.
            if (repeats(axis) && std::abs(d[axis]) > 0.5 * length[axis])
                d[axis] -= length[axis] * std::nearbyint(d[axis] / length[axis]);
        return d;
    }

    /// The periodic image of a point that lies in [lower, lower + length).
    Vec3 wrap(Vec3 x) const {
        for (int axis = 0; axis < 3; ++axis)
            if (repeats(axis))
                x[axis] -= length[axis] * std::floor((x[axis] - lower[axis]) / length[axis]);
        return x;
    }
};

}  // namespace turbidite::nscd
