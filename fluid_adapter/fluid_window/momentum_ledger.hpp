// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Checks the momentum balance of the fluid: its momentum changes only by what crosses its
// boundaries, by the body force of the case and by what the grains take. Per window,
//
//     P^{n+1} - P^n  =  dt rho_f a V  - sum over grains of dt lambda
//                                      + sum over boundary faces of impulses
//
// where the impulses are those of pressure (step 1), convection (2) and viscosity (3). They are
// computed from boundary values only, so that the balance is an independent check of the sum over
// cells; where viscosity is corrected with rigid grains (coupled_step.hpp) its impulse is that of
// the cells, and not checked. [N s], in the plane per unit length
#pragma once

#include <optional>
#include <vector>

#include "fluid_adapter/fluid_window/fluid_store.hpp"

namespace turbidite {

class MomentumLedger {
 public:
    /// `density`: rho_f [kg/m3].
    MomentumLedger(const StoredField& field, double density) : field_(field), density_(density) {}

    void open(double dt);  ///< before step 1 of a window of this length [s]: records P^n

    /// Adds what crossed the boundaries during `share` of dt.
    void add(const BoundaryForce& force, double share = 1.0);

    /// Adds forces that each acted during an equal part of dt.
    void add(const std::vector<BoundaryForce>& forces);

    /// Whether no cell of the fluid moved at the start of this window.
    bool began_at_rest() const { return at_rest_; }

    /// P^n becomes that of a fluid with this momentum more: it is to begin with it.
    void begin_with(const Vec3& momentum) { before_ = before_ + momentum; }

    /// The velocity was changed from outside between windows.
    void forget() { current_.reset(); }

    /// Whether P^{n+1} is finite.
    bool finite() const;

    /// P^{n+1}, after `close`.
    const Vec3& momentum() const { return current_->sum; }

    /// After step 5, with the sum of the multiplier impulses of all grains: |defect| over the
    /// largest of the terms, or over what their rounding could be if that is larger; zero if all
    /// of them are zero.
    double close(const Vec3& to_grains);

 private:
    const StoredField& field_;
    double density_;
    double dt_ = 0.0;
    std::optional<FluidMomentum> current_;  // P as it is
    Vec3 before_{};
    bool at_rest_ = false;
    Vec3 impulses_{};
    double largest_ = 0.0;
};

}  // namespace turbidite
