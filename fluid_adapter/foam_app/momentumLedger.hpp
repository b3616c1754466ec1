// SPDX-License-Identifier: GPL-3.0-or-later
//
// Does the fluid's momentum change by what crosses its boundaries and by what the grains take, and
// by nothing else? Per window,
//
//     P^{n+1} - P^n  =  - sum over grains of dt lambda  +  sum over boundary faces of impulses
//
// where the impulses are those of pressure (step 1), convection (2) and viscosity (3), taken from
// boundary values alone, so that the sum over cells is checked and not repeated. [N s/m]
#pragma once

#include <optional>
#include <vector>

#include "fluid_adapter/foam_app/createFields.hpp"
#include "fluid_adapter/foam_app/fluidStep.hpp"

namespace turbidite {

class MomentumLedger {
 public:
    explicit MomentumLedger(const FluidFields& fields) : fields_(fields) {}

    void open();  ///< before step 1: takes P^n

    /// What crossed the boundaries, over `share` of dt.
    void add(const BoundaryForce& force, double share = 1.0);

    /// In equal parts of dt.
    void add(const std::vector<BoundaryForce>& forces);

    /// U was changed from outside between windows.
    void forget() { current_.reset(); }

    /// P^{n+1} is a number.
    bool finite() const;

    /// After step 5, with the sum of the multiplier impulses of all grains: |defect| over the
    /// largest of the terms; zero if all are.
    double close(const Foam::vector& to_grains);

 private:
    const FluidFields& fields_;
    std::optional<Foam::vector> current_;  // P of U as it is
    Foam::vector before_{Foam::Zero};
    Foam::vector impulses_{Foam::Zero};
    Foam::scalar largest_ = 0.0;
};

}  // namespace turbidite
