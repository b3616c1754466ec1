// SPDX-License-Identifier: GPL-3.0-or-later
//
// Steps 1 to 3 of a window behind one door. Two kinds do the same to rounding:
//
//     BoxFluidStep   rows of a uniform box, without OpenFOAM's operators; where fvSolution names
//                    FFT for p and U, with the default transport scheme
//     OperatorStep   OpenFOAM's operators and tables, for everything else, with the solvers that
//                    fvSolution names
//
// U holds the velocity before `project` and after `diffuse`, and nothing in between.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "coupler/protocol/settings.hpp"
#include "fluid_adapter/box_step/box_step.hpp"
#include "fluid_adapter/foam_app/createFields.hpp"
#include "fluid_adapter/multiplier/cell_grid.hpp"

namespace turbidite {

/// What crosses the boundaries: the rate at which the fluid's momentum over rho_f changes, per unit
/// length out of the plane [m3/s2].
using BoundaryForce = BoxStep::Force;

struct Projection {
    FluxReport flux;
    BoundaryForce force;
};

class FluidStep {
 public:
    virtual ~FluidStep() = default;

    // Each tells what crossed the boundaries.

    virtual Projection project() = 0;  ///< step 1

    /// Step 2, in `parts` equal steps with the same flux: one force each.
    virtual std::vector<BoundaryForce> transport(int parts) = 0;
    virtual BoundaryForce diffuse() = 0;  ///< step 3

    /// After `diffuse`: no velocity is infinite or no number.
    virtual bool finite() const = 0;

    /// What the step keeps for itself and fields have as well: p.
    virtual void put_fields() {}

    /// What it knows beyond u and p: the excess flux, in an order of its own, and back. The kind of
    /// step says whose order.
    virtual std::int64_t kind() const = 0;
    virtual std::vector<double> memory() = 0;
    virtual void set_memory(const std::vector<double>& values) = 0;
};

/// The kind that fits the case. `cells`: the number i + nx j in the grid of each of this rank's
/// cells. Throws Failure (bad_input), naming the key, where FFT does not fit the mesh or a boundary
/// condition.
std::unique_ptr<FluidStep> make_fluid_step(const Settings& settings, FluidFields& fields,
                                           const CellGrid& grid, const std::vector<int>& cells);

}  // namespace turbidite
