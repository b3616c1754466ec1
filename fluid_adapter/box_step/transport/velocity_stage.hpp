// SPDX-License-Identifier: GPL-2.0-or-later
//
// A stage of a Runge-Kutta scheme for a velocity with the rate of change L (second_order.hpp):
//
//     result = old v + fresh (u + dt L(u)) + rate (now - before)
//
// One pass over the arrays, so that a stage is as cheap as a step of Euler's method. Valid C++17.
#pragma once

#include <vector>

namespace turbidite {

struct VelocityStage {
    /// The contiguous pieces of a velocity, in the host's order.
    using Values = std::vector<double*>;

    double dt = 0.0;
    bool viscous = false;  ///< L contains viscosity
    double old = 0.0, fresh = 1.0, rate = 0.0;
    Values u, v, now, before;  ///< any of them may be the same; v is not empty
    Values result;             ///< may be any of the others
    Values copy = {};          ///< of the result, if not empty
};

}  // namespace turbidite
