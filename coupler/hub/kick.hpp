// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The hydrodynamic force on a grain, defined here and nowhere else:
//
//     F_h = ∫λ + ρ_f V(R_h) dU/dt          T_h = ∫r×λ + I_f(R_h) dω/dt
//
// with dU/dt = (U^{n+1} - U^n)/Δt. Buoyancy is not part of it. Then, every window,
//
//     M dU/dt = (M - m_f) g + F_c + F_h
//
// to round-off, where F_c = J_c/Δt; `defect` measures it.
#pragma once

#include <unordered_map>

#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"
#include "coupler/shapes/immersed_body.hpp"

namespace turbidite {

class KickRule {
 public:
    KickRule(const Settings& settings, const ShapeTable& shapes);

    /// Fills force and torque. `before` is the state at t^n.
    void complete(std::vector<Kick>& kicks, const Motion& before, double step) const;

    /// Largest |M dU/dt - (M - m_f) g - F_c - F_h| (and the angular twin over R) over all grains,
    /// relative to the largest term that occurs. Empty windows give zero.
    double defect(const std::vector<Kick>& kicks, const Motion& before, const Motion& contact,
                  double step) const;

    /// M, I and their wet parts.
    ImmersedBody body(const GrainState& grain) const;

 private:
    double fluid_density_;
    double hydrodynamic_radius_;
    double gravity_;
    std::vector<std::shared_ptr<const Shape>> shapes_;
};

/// States by id.
std::unordered_map<GrainId, const GrainState*> by_id(const Motion& motion);

}  // namespace turbidite
