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

#include <array>
#include <optional>

#include "fluid_adapter/foam_app/createFields.hpp"

namespace turbidite {

class MomentumLedger {
 public:
    explicit MomentumLedger(const FluidFields& fields) : fields_(fields) {}

    void open();          ///< before step 1: takes P^n
    void add_pressure();  ///< after step 1, with p
    /// Before step 2 changes U, with phi, over `share` of dt.
    void add_convection(double share);
    void add_viscosity();  ///< after step 3, with U

    /// The same for boundary forces over rho_f, per unit length [m3/s2], over `share` of dt.
    void add(const std::array<double, 2>& force, double share = 1.0);

    /// U was changed from outside between windows.
    void forget() { current_.reset(); }

    /// P^{n+1} is a number.
    bool finite() const;

    /// After step 5, with the sum of the multiplier impulses of all grains: |defect| over the
    /// largest of the terms; zero if all are.
    double close(const Foam::vector& to_grains);

 private:
    template <class PerFace>
    void add_faces(PerFace per_face, double share = 1.0);
    void add_impulse(const Foam::vector& impulse);

    const FluidFields& fields_;
    std::optional<Foam::vector> current_;  // P of U as it is
    Foam::vector before_{Foam::Zero};
    Foam::vector impulses_{Foam::Zero};
    Foam::scalar largest_ = 0.0;
};

}  // namespace turbidite
