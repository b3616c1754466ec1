// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Step 5 for grains as the coupler sends them (coupler/protocol/records.hpp), in the two orders of
// a window:
//
//     split    constrain                              grains come with U^{n+4/5}
//     joint    release, then correct as often as the coupler asks
//
// and then `impose`, which writes u and yields the kicks. Under `joint` grains first move from
// U^n + g' dt, g' their weight over their inertia; contact impulses come afterwards, as pushes on
// the coupled system of fluid and grains, so that its momentum is exact whatever the effective
// inertia told to the contact solve. Valid C++17.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "coupler/protocol/settings.hpp"
#include "fluid_adapter/multiplier/uzawa_cg.hpp"

namespace turbidite {

class ImmersedStep {
 public:
    /// Reads fluid.points, fluid.point_spacing, fluid.multiplier_*, fluid.hydrodynamic_radius,
    /// coupling.tolerance (with coupling.scheme joint) and run.*.
    ImmersedStep(FluidField& field, const Settings& settings, const ShapeTable& shapes);

    /// Takes the grains that touch this rank and places their points; first call of a window.
    /// `step` [s]: under `joint` they fall freely over it, under `split` it is not used.
    void take(const std::vector<GrainState>& grains, double step);

    /// Multipliers of the grains taken.
    MultiplierResult solve();

    /// Applies contact impulses and solves again. Throws std::runtime_error unless they are for the
    /// grains taken, each once.
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
    ImmersedGrain immersed(const GrainState& state, double step) const;
    bool answers_for(std::size_t grain) const;

    FluidField& field_;
    std::vector<std::shared_ptr<const Shape>> shapes_;
    double fluid_density_, hydrodynamic_radius_, gravity_;
    bool joint_;
    MultiplierSettings settings_;
    double slip_goal_ = 0.0;  // of the window's first solve [m/s]

    std::vector<ImmersedGrain> grains_;
    std::unordered_map<GrainId, std::size_t> index_;
    std::vector<Planar> contact_impulses_;  // J, pushed so far
    std::vector<Planar> changes_;
    std::vector<Planar> told_;  ///< velocities that came with the last contact impulses
    std::vector<double> mismatch_;
    PointPlacement placement_;
    CollocationPoints points_;
    SaddlePoint system_;
    MultiplierWorkspace work_;
};

}  // namespace turbidite
