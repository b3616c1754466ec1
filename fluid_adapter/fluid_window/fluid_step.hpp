// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Interface of steps 1 to 3 of a window. There are two implementations, equal to rounding:
//
//     BoxFluidStep   rows of a box (box_fluid_step.hpp), if the case's transport scheme is one they
//                    know and its solvers are FFT
//     OperatorStep   OpenFOAM's operators and tables with the solvers that fvSolution names, for
//                    everything else (foam_app/operators/operatorStep.hpp)
//
// A step that works on contiguous components keeps the velocity in them from window to window, for
// the multiplier method as well, and the field u of the store (fluid_store.hpp) follows when
// somebody asks. For others the field holds it before `project` and after `diffuse`. Valid C++17.
#pragma once

#include <cstdint>
#include <vector>

#include "fluid_adapter/box_step/box_step.hpp"
#include "fluid_adapter/box_step/transport/second_order.hpp"
#include "fluid_adapter/coupled_step/coupled_step.hpp"

namespace turbidite {

/// What crosses the boundaries: the rate of change of the fluid's momentum over rho_f [m4/s2], in
/// the plane per unit length [m3/s2].
using BoundaryForce = BoxStep::Force;

struct Projection {
    FluxReport flux;
    BoundaryForce force;
};

/// How `memory` is made of arrays over complete rows of the box, for another number of ranks.
struct MemoryRows {
    struct Array {
        std::size_t width = 0;  ///< values per row; 0: a single value, the same on all ranks
        std::size_t above = 0;  ///< rows beyond the rank's last one, which the next rank also has
    };
    std::size_t first = 0, count = 0;  ///< rows of this rank
    std::vector<Array> arrays;         ///< one after the other; empty: in no such order
};

class FluidStep {
 public:
    virtual ~FluidStep() = default;

    /// A window of this length begins [s].
    virtual void begin(double) {}

    // Each step returns what crossed the boundaries in it.

    virtual Projection project() = 0;  ///< step 1

    /// How transport cuts a window whose flux has this Courant number
    /// (FluxReport::carried_courant).
    virtual TransportParts parts(double courant) const = 0;

    /// Step 2, in equal sub-steps with the same flux; one force each.
    virtual std::vector<BoundaryForce> transport(const TransportParts& parts) = 0;
    virtual BoundaryForce diffuse() = 0;  ///< step 3

    /// The part that corrects pressure and viscosity together with the grains, after `diffuse`;
    /// null: they are final then (Marchuk-Yanenko). Where it is not null, `project` only makes the
    /// flux solenoidal and `diffuse` predicts; neither reports forces, `end_coupled` does.
    virtual CoupledStep* coupled() { return nullptr; }

    /// Ends the window of `coupled`: forces of pressure and viscosity.
    virtual std::vector<BoundaryForce> end_coupled() { return {}; }

    /// After `diffuse`: no velocity is infinite or no number.
    virtual bool finite() = 0;

    /// One component of u over this rank's cells, in their order [m/s]: the velocity itself. Null
    /// where the field holds it.
    virtual double* velocity(int) { return nullptr; }

    /// The rows that it works on, if any, whose values other ranks can be asked for.
    virtual BoxRows* rows() { return nullptr; }

    // Between the step's own values and the fields u and p:

    virtual void put_velocity() {}                        ///< into u
    virtual void put_unconstrained() { put_velocity(); }  ///< before the grains, in their window
    virtual void take_velocity() {}                       ///< from u, which was changed
    virtual void put_pressure() {}                        ///< into p

    /// The values that u holds on sides of the box were changed, before `project`.
    virtual void sides_changed() {}

    /// u was changed from outside: what the step knows of earlier windows' rates is void.
    virtual void forget_rates() {}

    /// p, where `coupled` is not null, is none that the next window could go on from.
    virtual void forget_pressure() {}

    /// State beyond u and p: the excess flux, in the step's own order; saved and restored. `kind`
    /// identifies the implementation, and so the order.
    virtual std::int64_t kind() const = 0;
    virtual std::vector<double> memory() = 0;
    virtual void set_memory(const std::vector<double>& values) = 0;
    virtual MemoryRows memory_rows() const { return {}; }
};

}  // namespace turbidite
