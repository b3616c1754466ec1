// SPDX-License-Identifier: GPL-3.0-or-later
//
// Steps 1 to 3 of a window behind one door. Two kinds do the same to rounding:
//
//     BoxFluidStep   rows of a uniform box, without OpenFOAM's operators; with both direct solvers
//                    and the default transport scheme
//     OperatorStep   OpenFOAM's operators and tables, for everything else
//
// U holds the velocity before `project` and after `diffuse`, and nothing in between.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "coupler/protocol/settings.hpp"
#include "fluid_adapter/box_step/box_step.hpp"
#include "fluid_adapter/foam_app/createFields.hpp"
#include "fluid_adapter/foam_app/momentumLedger.hpp"

namespace turbidite {

class FluidStep {
 public:
    virtual ~FluidStep() = default;

    // Each adds to the ledger what crosses the boundaries.
    virtual FluxReport project(MomentumLedger& ledger) = 0;

    /// In `parts` equal steps with the same flux.
    virtual void transport(MomentumLedger& ledger, int parts) = 0;
    virtual void diffuse(MomentumLedger& ledger) = 0;

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

/// The kind that fits the settings and the mesh. Throws Failure as solverList.hpp does.
std::unique_ptr<FluidStep> make_fluid_step(const Settings& settings, FluidFields& fields);

}  // namespace turbidite
