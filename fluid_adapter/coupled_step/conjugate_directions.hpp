// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The loop of the method of conjugate gradients, for a problem that keeps its own vectors. Valid
// C++17.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "fluid_adapter/box_step/box_operators.hpp"

namespace turbidite {

struct IterationResult {
    int iterations = 0;
    double residual = 0.0;  ///< in the unit of the tolerance
    bool converged = true;
    bool broke_down = false;  ///< a direction had no positive curvature; nothing came of it
};

struct IterationLimit {
    int most = 1;
    double tolerance = 0.0;
    double reduction = 0.0;        ///< also enough: this part of the first residual
    double slip_reduction = 1e-3;  ///< of one direction; what is left adds to the flow's own slip
    double longest_step = std::numeric_limits<double>::infinity();  ///< of alpha
};

/// Of a residual, over all ranks: what its rms is made of.
struct ResidualSquare {
    double sum = 0.0;    ///< |r|^2
    double cells = 0.0;  ///< both weighted by volumes as in box_operators.hpp

    static constexpr int count = 2;
    double* data() { return &sum; }
};
static_assert(sizeof(ResidualSquare) == ResidualSquare::count * sizeof(double));

/// Iterates until |r| <= tolerance sqrt(scale) or less than the reduction asks for, from |r|^2 =
/// `square`. `choose(first, rz)` finds the next direction from z and the r.z of the last one, and
/// replaces that unless it is the first; `apply()` returns the products of its image; `move(alpha)`
/// goes along it.
template <class Choose, class Apply, class Move>
IterationResult iterate(const IterationLimit& limit, double square, double scale, Choose choose,
                        Apply apply, Move move) {
    IterationResult result;
    result.residual = std::sqrt(square / scale);
    const double enough = std::max(limit.tolerance, limit.reduction * result.residual);
    double rz = 0.0;  // of the last direction
    while (result.residual > enough && result.iterations < limit.most) {
        choose(result.iterations == 0, rz);
        const ImageProducts image = apply();
        result.broke_down = !(image.direction > 0.0);
        if (result.broke_down) break;
        if (result.iterations == 0) rz = image.step;
        const double alpha = std::min(rz / image.direction, limit.longest_step);
        move(alpha);
        // |r - alpha A d|^2
        square =
            std::max(0.0, square - 2.0 * alpha * image.residual + alpha * alpha * image.itself);
        ++result.iterations;
        result.residual = std::sqrt(square / scale);
    }
    result.converged = result.residual <= enough;
    return result;
}

}  // namespace turbidite
