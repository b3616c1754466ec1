// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a window needs of the program that keeps the fluid: the fields that users and files see, and
// the time they belong to. OpenFOAM is one such program (foam_app/foamStore.hpp). Valid C++17.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "fluid_adapter/domain/side_motion.hpp"
#include "fluid_adapter/fluid_window/fluid_step.hpp"
#include "fluid_adapter/multiplier/constraint.hpp"
#include "fluid_adapter/multiplier/fluid_field.hpp"
#include "fluid_adapter/ranks/rank_group.hpp"

namespace turbidite {

/// Per unit length in two dimensions.
struct FluidMomentum {
    Vec3 sum{};               ///< [N s]
    double magnitudes = 0.0;  ///< of the cells' components, without their signs [N s]
};

/// The velocity for the multiplier method. Where a step keeps it (FluidStep::velocity), `load` and
/// `store` have nothing to do.
class StoredField : public FluidField {
 public:
    /// From the fields, in cells of the constraint and those that other ranks know; no other is
    /// read.
    virtual void load(const Constraint& constraint) = 0;

    /// Into the fields, in cells of the constraint only.
    virtual void store(const Constraint& constraint) = 0;

    /// lambda = -rho_f (u - u3)/dt in the cells of the constraint, with the u3 of the fields;
    /// before `store`.
    virtual void put_force_density(const Constraint& constraint) = 0;

    /// Whether anybody is shown lambda, for which a window keeps its u3.
    virtual bool shows_force_density() const { return true; }

    /// Adds a velocity to u in every cell [m/s].
    virtual void accelerate(const Vec3& change) = 0;

    virtual FluidMomentum momentum() const = 0;  ///< of all fluid

    // The fields in one of this rank's cells, as those see them who write them:

    virtual double shown_pressure(int cell) const = 0;  ///< over rho_f [m2/s2]
    virtual Vec3 shown_velocity(int cell) const = 0;    ///< [m/s]
};

class FluidStore {
 public:
    virtual ~FluidStore() = default;

    virtual StoredField& field() = 0;
    virtual FluidStep& step() = 0;
    virtual const RankGroup& ranks() const = 0;
    virtual double density() const = 0;  ///< rho_f [kg/m3]

    /// Up to which rows of cells have the case's resolution [m]; infinite where all have it.
    virtual double equal_height() const = 0;

    /// Begins a window: its time, and the velocities of the box's sides.
    virtual MovedSides begin(const Window& window) = 0;

    /// Whether the present window is the last of the run.
    virtual bool finished() const = 0;

    /// Somebody looks at the fields after every window (`show`).
    virtual bool observed() const = 0;

    /// Shows the fields, with these grains, to those who look at them: they are those of the end of
    /// the window, which is over but for that.
    virtual void show(const std::vector<ImmersedGrain>& grains) = 0;

    /// The flux of the fields from their velocity.
    virtual void interpolate_flux() = 0;
    virtual double largest_divergence() const = 0;  ///< of that flux [1/s]

    /// p/rho_f [m2/s2], u, v and in space w [m/s] of the fields at each point of output.probes.
    virtual std::vector<double> probes() const = 0;

    /// Writes the fields, with these grains where output.fields asks for them.
    virtual void write(const std::vector<ImmersedGrain>& grains) = 0;

    /// Writes planes of the fields at every output, with these grains.
    virtual void write_slices(const std::vector<ImmersedGrain>&) {}

    /// Runs `work`; errors of the program become a Failure that names the activity.
    virtual void guard(const std::string& doing, const std::function<void()>& work) const = 0;

    /// A line for the program's log.
    virtual void log(const std::string& line) const = 0;
};

}  // namespace turbidite
