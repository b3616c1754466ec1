// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Step 5 for grains as the coupler sends them (coupler/protocol/records.hpp). In a window grains
// are taken once, in one of two ways:
//
//     free         at t^n; they move from U^n + g' dt, g' their weight over their inertia
//     constrained  after a contact solve, with the velocities and impulses that they bring
//
// then come solve, push as often as the coupler asks, and `impose`, which writes u and yields the
// kicks. A push applies what contact impulses have changed by to the coupled system of fluid and
// grains, so that its momentum is exact whatever the effective inertia told to the contact solve.
// Valid C++17.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "coupler/protocol/settings.hpp"
#include "coupler/shapes/immersed_bodies.hpp"
#include "fluid_adapter/multiplier/uzawa_cg.hpp"

namespace turbidite {

class ImmersedStep {
 public:
    /// Reads fluid.points, fluid.point_spacing, fluid.multiplier_iterations,
    /// fluid.hydrodynamic_radius, and run.*: run.slip_tolerance among them.
    ImmersedStep(FluidField& field, const Settings& settings, const ShapeTable& shapes);

    /// Takes the grains that touch this rank and places their points; first call of a window. They
    /// fall freely over `step` [s].
    void take_free(const std::vector<GrainState>& grains, double step);

    /// The same for grains that come with velocities in which their contact impulses are contained.
    void take_constrained(const std::vector<GrainState>& grains);

    /// Multipliers of the grains taken.
    MultiplierResult solve();

    /// Applies what the contact impulses have changed by and solves again. Throws
    /// std::runtime_error unless they are for the grains taken, each once.
    MultiplierResult push(const std::vector<GrainState>& with_contacts);

    /// Of the grains whose centre this rank owns. Mismatches are those of the last push.
    std::vector<FreeResponse> responses() const;

    /// Writes u into the field; last call of a window.
    void impose();

    /// Of the grains whose centre this rank owns; after impose.
    std::vector<Kick> kicks() const;

    /// Sum of the multiplier impulses of these grains [N s/m]; after impose.
    Planar impulse_to_grains() const;

    const CollocationPoints& points() const { return points_; }

 private:
    ImmersedGrain immersed(const GrainState& state) const;
    void take(const std::vector<GrainState>& states);
    bool answers_for(std::size_t grain) const;

    FluidField& field_;
    std::vector<std::shared_ptr<const Shape>> shapes_;
    ImmersedBodies bodies_;
    double hydrodynamic_radius_, gravity_;
    MultiplierSettings settings_;
    double slip_goal_ = 0.0;  // of the window's first solve [m/s]

    std::vector<ImmersedGrain> grains_;
    std::unordered_map<GrainId, std::size_t> index_;
    std::vector<Planar> contact_impulses_;  // J, contained in the motions so far
    std::vector<Planar> changes_;
    std::vector<Planar> solved_;  // velocities that came with the last contact impulses
    std::vector<double> mismatch_;
    PointPlacement placement_;
    CollocationPoints points_;
    SaddlePoint system_;
    MultiplierWorkspace work_;
};

}  // namespace turbidite
