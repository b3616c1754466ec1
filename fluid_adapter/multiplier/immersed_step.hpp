// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Step 5 for grains as the coupler sends them (coupler/protocol/records.hpp). The grains of a
// window are taken once, in one of two ways:
//
//     free         at t^n, moving with U^n + g' dt, where g' is their submerged weight over cM
//     constrained  after a contact solve, with the velocities and impulses it found
//
// Behind them come the walls inside the box (immersed_walls.hpp), which only the fluid knows as
// bodies. Grains that follow run.grain_motions have its velocities.
//
// Then follow solve, push as often as the coupler asks, and `impose`, which writes u and makes the
// kicks available. A push applies the changes of the contact impulses to the coupled system of
// fluid and grains, whose momentum is therefore exact even if the effective inertia used by the
// contact solve is approximate. Valid C++17.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "coupler/protocol/run_values.hpp"
#include "coupler/shapes/immersed_bodies.hpp"
#include "fluid_adapter/multiplier/constraint.hpp"
#include "fluid_adapter/multiplier/fluid_field.hpp"
#include "fluid_adapter/multiplier/immersed_walls.hpp"

namespace turbidite {

class ImmersedStep {
 public:
    /// Reads fluid.points, fluid.point_spacing, fluid.multiplier_iterations,
    /// fluid.hydrodynamic_radius, and run.*: run.slip_tolerance among them.
    ImmersedStep(FluidField& field, const Settings& settings, const ShapeTable& shapes);

    /// Takes the grains that touch this rank and places their points; first call of a window. The
    /// grains are free, and fall for its length; with a splitting that corrects with rigid grains
    /// they also have the contact impulses of the last window, until `push` corrects them.
    void take_free(const std::vector<GrainState>& grains, const Window& window);

    /// The same for grains whose velocities already contain their contact impulses.
    void take_constrained(const std::vector<GrainState>& grains, const Window& window);

    /// Whether a free grain of this rank moves at the start of the window, beyond rounding.
    bool begins_in_motion() const;

    /// Whether a body whose motion is given moves in the window.
    bool is_driven() const;

    /// A fluid at rest moves with the free grains that it is to begin with: adds to the field's
    /// velocity that which satisfies the constraint with their U^n, and with all other bodies at
    /// rest. The grains keep what they have. Before `solve`; by every rank of the fluid.
    MultiplierResult carry_fluid_along();

    /// Solves for the multipliers of the grains taken.
    MultiplierResult solve();

    /// Applies the changes of the contact impulses and solves again. Throws std::runtime_error
    /// unless there is exactly one entry for each grain taken.
    MultiplierResult push(const std::vector<GrainState>& with_contacts);

    /// Responses of the grains whose centre this rank owns. Mismatches are between the
    /// velocities sent and those of the last push.
    std::vector<FreeResponse> responses() const;

    /// Writes u into the field; last call of a window.
    void impose();

    /// Kicks of the grains whose centre this rank owns; after impose.
    std::vector<Kick> kicks() const;

    /// Sum of the multiplier impulses over these bodies, and of their moments; after impose.
    Impulse impulse_to_grains() const;

    /// The grains and walls of the window, as the multipliers see them.
    const std::vector<ImmersedGrain>& grains() const { return grains_; }

    /// Between solve and impose, for changes of the velocity from outside.
    Constraint& constraint() { return *constraint_; }
    const Constraint& constraint() const { return *constraint_; }

 private:
    /// How contacts and fluid come to one velocity.
    struct Agreement {
        bool carries_contacts;  // from window to window
        double tolerance;       // of the velocity [m/s]; 0 without coupling.tolerance
    };

    ImmersedGrain immersed(const GrainState& state) const;
    bool moves(const Twist& motion) const;
    Vec3 driving(const GrainState& state, double step) const;
    Impulse weight(const GrainState& state, double step) const;
    Twist before_contacts(const ImmersedGrain& grain, const GrainState& state, double step) const;
    void take(const std::vector<GrainState>& states, const Window& window);
    void prescribe(const Window& window);
    void note_moved(ImmersedGrain& grain, const Window& window) const;
    bool answers_for(std::size_t grain) const;
    FreeResponse response(std::size_t g) const;
    double mismatch(std::size_t g) const;

    FluidField& field_;
    std::vector<std::shared_ptr<const Shape>> shapes_;
    RunValues run_;
    ImmersedBodies bodies_;
    ImmersedWalls walls_;
    std::vector<Moved> moved_grains_;
    Agreement agreement_;

    std::vector<ImmersedGrain> grains_;  // and walls
    std::size_t states_ = 0;             // of the grains alone
    std::unordered_map<GrainId, std::size_t> index_;
    std::vector<Impulse> contact_impulses_;  // J, contained in the present motions
    std::vector<Impulse> changes_;
    std::vector<Twist> solved_;  // velocities that came with the last contact impulses
    bool pushed_ = false;        // contacts have been solved in this window
    std::unique_ptr<Constraint> constraint_;
};

}  // namespace turbidite
