// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A window in which pressure and viscosity know that grains are rigid, instead of steps 1, 3 and 5
// one after the other (Topin 2011, section 2.1.2). With W the constraint of the grains
// (rigid_grains.hpp), u^n rigid and nearly solenoidal, P^n the grains' momenta with their weight
// and the contact impulses of the last window:
//
//     begin
//     (transport of u^n with a solenoidal flux gives
//                s = transported u^n + f - dt G p^n,   f = dt nu L u^n, u^n with the body force)
//     place_grains
//     (u, U) = W(s, P^n)
//     correct    f: u = W(s), f = dt nu L u           rigid_viscosity.hpp
//                p: D u + div e = 0                   rigid_pressure.hpp
//     end        p^{n+1}, e^{n+1}
//
// What a window leaves to the next one is u, p and e. Valid C++17.
#pragma once

#include "fluid_adapter/coupled_step/rigid_pressure.hpp"

namespace turbidite {

struct CoupledLimits {
    /// To the tolerances. Otherwise pressure within its limit, a single iteration but where a fluid
    /// at rest begins to move, and viscosity, within its limit of iterations, to a tenth of what
    /// was missing, or less where that of the shortest waves would stay too strong.
    bool iterated = false;
    IterationLimit viscosity;  ///< tolerance: rms of the missing viscous acceleration [m/s2]
    IterationLimit pressure;   ///< tolerance: rms of div [1/s]
};

struct CoupledReport {
    IterationResult viscosity, pressure;  ///< residuals as in CoupledLimits
    MultiplierResult slip;                ///< if iterated
    int corrections = 0;                  ///< of viscosity
    bool converged = true;                ///< what was asked for was reached
};

class CoupledStep {
 public:
    explicit CoupledStep(BoxStep& step)
        : step_(step), box_(step.operators()), pressure_(step, work_), viscosity_(work_) {}
    CoupledStep(const CoupledStep&) = delete;  // both refer to its arrays
    CoupledStep& operator=(const CoupledStep&) = delete;

    /// Before transport over dt [s], which is to add what it returns.
    ImpulsesOfWindow& begin(double dt) { return viscosity_.begin(dt_ = dt, step_.viscosity()); }

    /// ImpulsesOfWindow::sum_u
    double sum_of_transported() const { return viscosity_.sum_of_transported(); }

    /// After transport: keeps it, if asked to.
    void keep_transported();

    /// Exchanges work arrays for those that transport has no use for until the next one begins, and
    /// back: six numbers per cell less.
    void exchange_work(std::vector<std::vector<double>>& stages, FaceValues& flux);

    /// Keeps s of the next window.
    void keep_unconstrained(bool keep) { keep_ = keep; }

    /// Once per window, before the first correct. `a`: of a body force on the fluid [m/s2], which
    /// the velocity has had.
    void place_grains(Constraint& constraint, const std::array<double, 3>& a = {});

    /// Whether p is zero in all cells of this rank.
    bool begins_without_pressure() const;

    CoupledReport correct(RigidGrains& grains, const CoupledLimits& limits);

    /// s of the window with its last f and p, if kept [m/s]: once, since it is given away.
    VelocityRows unconstrained();

    /// Ends the window: e becomes that of p.
    void end() { pressure_.end(box_); }

    /// Momentum over rho_f of the viscous impulses in this rank's cells, per time [m4/s2], in the
    /// plane also per unit length [m3/s2]: that of the sides, to the tolerance of viscosity.
    BoxStep::Force viscous_force();

 private:
    bool correct_viscosity(RigidGrains& grains, const CoupledLimits& limits, CoupledReport& report);
    bool correct_pressure(RigidGrains& grains, const CoupledLimits& limits, CoupledReport& report);
    double shortest_waves() const;
    bool one_viscous_iteration_will_do() const;
    double slip_reduction() const;
    IterationLimit one_viscous_correction(int most) const;
    void add_impulses(double sign, VelocityRows& u);

    BoxStep& step_;
    BoxOperators box_;
    CorrectionWork work_;
    RigidPressure pressure_;
    RigidViscosity viscosity_;
    VelocityRows transported_;
    double dt_ = 0.0;
    bool keep_ = false;
};

}  // namespace turbidite
