// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace turbidite {

/// Time spent in the parts of a window [s].
struct FluidTimings {
    double projection = 0.0, transport = 0.0, viscosity = 0.0, points = 0.0, multipliers = 0.0,
           correction = 0.0, output = 0.0;

    double together() const {
        return projection + transport + viscosity + points + multipliers + correction + output;
    }
};

}  // namespace turbidite
