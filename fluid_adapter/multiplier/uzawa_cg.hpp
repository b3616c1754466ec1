// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Preconditioned conjugate gradients on the multipliers (Uzawa; Wachs 2011, appendix, with its two
// signs corrected): S L = s of saddle_point.hpp, where the residual s - S L is the slip left at the
// boundary points.
//
// Every window begins at L = 0: the points move over the grid, so last window's multipliers belong
// to other places, and would be state to save, for one of about three iterations.
//
// Valid C++17.
#pragma once

#include <cstdint>
#include <vector>

#include "fluid_adapter/multiplier/saddle_point.hpp"

namespace turbidite {

struct MultiplierSettings {
    double tolerance = 1e-4;  ///< of the rms slip, over u_c; usual 1e-4 .. 1e-6
    double reduction = 1e-2;  ///< least reduction of the first rms slip: with a short dt the slip
                              ///< is below `tolerance` at once and the grain would not feel
                              ///< the fluid
    double velocity_scale = 1.0;  ///< u_c [m/s]
    int iterations = 200;         ///< at most
};

struct MultiplierResult {
    std::int64_t iterations = 0;
    double residual = 0.0;  ///< rms slip [m/s]
    double goal = 0.0;      ///< what it had to fall below
    bool converged = true;
};

/// Vectors of the iteration; kept between windows so that nothing is allocated in a solve that is
/// no larger than an earlier one.
struct MultiplierWorkspace {
    std::vector<double> impulses, direction, image, preconditioned;

    void resize(int rows);
};

/// Reduces the system's slip until it is below both rules; the system's motions follow.
MultiplierResult uzawa_cg(SaddlePoint& system, const MultiplierSettings& settings,
                          MultiplierWorkspace& work);

}  // namespace turbidite
