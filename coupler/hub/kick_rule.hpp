// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The hydrodynamic force on a grain, defined only here:
//
//     F_h = ∫λ + ρ_f V(R_h) dU/dt          T_h = ∫r×λ + I_f(R_h) dω/dt
//
// with dU/dt = (U^{n+1} - U^n)/Δt. Buoyancy is not included. Then, in every window,
//
//     M dU/dt = (M - m_f) g + F_c + F_h
//
// to round-off, where F_c = J_c/Δt; without a fluid M dU/dt = M g + F_c. The balances measure it,
// and their angular counterparts divided by R, relative to the largest term of all grains. Grains
// with a given motion are left out: what moves them takes the rest.
#pragma once

#include <optional>
#include <unordered_set>
#include <vector>

#include "coupler/output/window_result.hpp"
#include "coupler/protocol/grain_index.hpp"
#include "coupler/shapes/immersed_bodies.hpp"

namespace turbidite {

class KickRule {
 public:
    /// Grains with a given motion are those that `population` calls prescribed, whatever a message
    /// says.
    KickRule(const RunValues& run, const ShapeTable& shapes,
             const std::vector<GrainState>& population);

    /// Fills force and torque. `before` is the state at t^n. Throws PhysicsRefused for a kick of an
    /// unknown grain.
    void complete(std::vector<Kick>& kicks, const Motion& before, double step);

    /// Of a window with a fluid. Zero without grains.
    GrainBalance balance(const std::vector<Kick>& kicks, const Motion& before,
                         const Motion& contact, double step);

    /// Of a window without a fluid. `before` and `after` are the states at its ends.
    GrainBalance balance(const Motion& before, const Motion& after, double step);

    /// What balance found, or, if the state that follows has other velocities than the kicks or
    /// other contact impulses than `contact`, by more than twice that, how far it is from them.
    GrainBalance with_state(GrainBalance so_far, const std::vector<Kick>& kicks,
                            const Motion& contact, const Motion& state);

 private:
    /// Valid until the next call. Grains that follow each other are often of one kind.
    const ImmersedBody& body_of(const GrainState& grain);
    bool has_given_motion(GrainId id) const { return !given_.empty() && given_.count(id) > 0; }

    ImmersedBodies bodies_;
    std::unordered_set<GrainId> given_;
    GrainState last_;  ///< of the last call
    std::optional<ImmersedBody> last_body_;
    double gravity_;
    GrainIndex before_, contact_, state_;
};

}  // namespace turbidite
