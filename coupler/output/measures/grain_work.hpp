// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The work that contacts and fluid do on the grains in a window. With the mean velocities
// Ū = (Uⁿ + Uⁿ⁺¹)/2, ω̄ likewise,
//
//     W_c = Σ (J_c·Ū + K_c·ω̄)        W_h = Δt Σ (F_h·Ū + T_h·ω̄)
//
// M dU = (M − m_f) g Δt + J_c + Δt F_h times Ū is then exact: the change of the kinetic energy is
// W_c + W_h + Δt Σ (M − m_f) g·Ū. As positions move with Uⁿ⁺¹, the potential energy Σ (M − m_f) g y
// changes by that weight's work plus ½ Δt Σ (M − m_f) g (Uⁿ⁺¹ − Uⁿ)·e_y, so that kinetic and
// potential energy change by W_c + W_h up to Σ (M − m_f) g ½ Δt ΔU_y, which does not add up.
#pragma once

#include "coupler/output/window_result.hpp"
#include "coupler/protocol/grain_index.hpp"

namespace turbidite {

/// [J]
struct GrainWork {
    double contacts = 0.0;
    double fluid = 0.0;
    double films = 0.0;  ///< part of `contacts`, as the grains' program tells it

    GrainWork& operator+=(const GrainWork& other);
};

class WorkOnGrains {
 public:
    /// Over the window of length `step` [s] that leads from `before` to `result`. Grains whose
    /// motion is prescribed, or which have left, do not count.
    GrainWork operator()(const Motion& before, const WindowResult& result, double step);

 private:
    GrainIndex before_, after_;
};

}  // namespace turbidite
