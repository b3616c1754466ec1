// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The constraint of step 5: fluid inside grains, and at their surfaces, moves with them (Topin
// 2011, Eq. 10). It maps a velocity u3 of the fluid and momenta P of the grains to a velocity that
// satisfies it, and to the motions of the grains:
//
//     (u, U) = W(u3, P)
//
// W is linear, and symmetric in the product of momenta. There are two implementations:
//
//     PlaneConstraint      points inside and on the surface of grains, by Uzawa's method
//     InteriorConstraint   cells inside spheres, in closed form (space/interior_constraint.hpp)
//
// A window places its grains, solves, and imposes; pushes (contact impulses) may follow in any
// order and number, and so may changes of the velocity from outside, which are made rigid and then
// added. Every rank calls the same. Valid C++17.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "fluid_adapter/multiplier/cell_side.hpp"
#include "fluid_adapter/multiplier/components.hpp"
#include "fluid_adapter/multiplier/immersed_grain.hpp"

namespace turbidite {

struct MultiplierSettings {
    double tolerance = 1e-4;  ///< of the rms slip over u_c; usually 1e-4 .. 1e-6
    /// The rms slip must also fall by this factor: with a short dt it may be below `tolerance` from
    /// the start, and the grain would not feel the fluid.
    double reduction = 1e-2;
    double velocity_scale = 1.0;  ///< u_c [m/s]
    int iterations = 200;         ///< upper limit
};

struct MultiplierResult {
    std::int64_t iterations = 0;
    double residual = 0.0;  ///< rms slip [m/s]
    double goal = 0.0;      ///< rms slip required [m/s]
    bool converged = true;
};

/// What a change of the fluid's velocity does to the grains of a window: numbers that are linear in
/// the change, in an order that the constraint alone knows.
using GrainChange = std::vector<double>;

class Constraint {
 public:
    virtual ~Constraint() = default;

    /// Begins a window with its grains, kept by reference.
    virtual void place(const std::vector<ImmersedGrain>& grains) = 0;

    /// (u, U) = W(u3, P) with the momenta of the grains (ImmersedGrain::momentum); u is kept by
    /// reference. Throws PhysicsRefused naming a grain that ties too little fluid.
    virtual MultiplierResult solve(const VelocityPointers& u) = 0;

    /// Adds impulses to the grains. All ranks that hold a grain must pass the same values.
    virtual MultiplierResult push(const std::vector<Impulse>& impulses) = 0;

    /// Writes u into the velocity that `solve` began with.
    virtual void impose() = 0;

    virtual Twist motion(std::size_t grain) const = 0;

    /// Sum of dt lambda over a grain, of all that was imposed.
    virtual Impulse impulse(std::size_t grain) const = 0;

    /// Inertia of a grain with the fluid tied to it, as in FreeResponse; not for grains of
    /// prescribed motion.
    virtual std::array<double, 21> effective_inertia(std::size_t grain) const = 0;

    /// What an impulse changes in the motion of a grain by itself, with this inertia.
    virtual Twist moved_by(std::size_t grain, const Impulse& impulse) const = 0;

    /// Calls `visit` with every cell of this rank whose velocity is read or written.
    virtual void for_cells(const std::function<void(int)>& visit) const = 0;

    /// Sets the values of this rank's cells that are part of grains to zero.
    virtual void clear_covered(double* values) const = 0;

    /// Whether this rank has a body of prescribed motion.
    virtual bool has_driven() const = 0;

    /// Sets the values of this rank's cells that are part of such bodies to one.
    virtual void mark_driven(double* values) const = 0;

    /// Faces between cells of grains that touch on the mesh, or touch a wall, which are to carry a
    /// film of liquid (box_step/wedge_flow.hpp), from both cells as far as they are this rank's. In
    /// the plane none: there pores between grains that touch are closed.
    virtual const std::vector<CellSide>& film_sides() {
        static const std::vector<CellSide> none;
        return none;
    }

    // Changes of the velocity from outside, after `impose`:

    /// change <- W change, and what it does to the grains. The slip is reduced by the factor
    /// `reduction`.
    virtual MultiplierResult make_rigid(const VelocityPointers& change, double reduction,
                                        GrainChange& of_grains) = 0;

    /// The grains take `share` of a change. The caller adds that of the velocity itself.
    virtual void add(const GrainChange& change, double share) = 0;

    /// Removes the slip that changes have left in the window's velocity.
    virtual MultiplierResult settle() = 0;

    virtual void sum_over_ranks(double* values, int count) const = 0;
};

}  // namespace turbidite
