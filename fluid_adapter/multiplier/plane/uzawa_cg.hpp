// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Uzawa's method as preconditioned conjugate gradients on the multipliers (Wachs 2011, appendix,
// with its two signs corrected): solves S L = s of saddle_operator.hpp, whose residual s - S L is
// the slip left at the boundary points.
//
// Every window starts from L = 0. The points move over the grid, so the multipliers of the last
// window belong to other positions; reusing them would save about one of three iterations and would
// make them part of the saved state. Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/multiplier/constraint.hpp"
#include "fluid_adapter/multiplier/plane/constrained_flow.hpp"

namespace turbidite {

/// Work vectors, kept between windows: a solve no larger than an earlier one allocates nothing.
struct MultiplierWorkspace {
    Multipliers impulses, direction, preconditioned;
    std::vector<double> image;

    void clear(int rows, std::size_t grains);
};

/// Reduces the slip of the flow until both criteria of MultiplierSettings hold, and updates its
/// motions.
MultiplierResult uzawa_cg(ConstrainedFlow& flow, const MultiplierSettings& settings,
                          MultiplierWorkspace& work);

}  // namespace turbidite
