// SPDX-License-Identifier: GPL-2.0-or-later
//
// Steps 1 to 3 of a window on the layers of a box (box_layers.hpp), uniform or with rows of
// different heights (row_heights.hpp; Topin 2011, section 2.1.2), on contiguous arrays of the
// components of u. The results equal those of OpenFOAM's operators
// (foam_app/operators/operatorStep.hpp) to rounding:
//
//     1  projection   phi1 = S.u + k e - dt S.grad p,  div phi1 = 0,   u1 = u - dt grad p,
//                     e = phi1 - S.u1        k, e: foam_app/operators/stokesProjection.hpp
//     2  transport    u2 = u1 - dt div(phi1 u1)                        convective_flux.hpp
//     3  viscosity    u3 - dt nu laplacian(u3) = u2
//
// Fluxes are face velocities: phi over |S|. The flux is not stored, but recomputed as e + S.u1,
// with a value of e per cell and axis beside u and p; only transport in several sub-steps stores
// it. Each step reads and writes its fields once. Valid C++17.
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "fluid_adapter/box_step/box_operators.hpp"
#include "fluid_adapter/box_step/pressure_projection.hpp"
#include "fluid_adapter/box_step/side_forces.hpp"
#include "fluid_adapter/box_step/transport/momentum_transport.hpp"
#include "fluid_adapter/linear_solvers/separable_solve.hpp"

namespace turbidite {

class BoxStep {
 public:
    /// On this rank's rows of the box.
    BoxStep(const BoxFluid& fluid, std::unique_ptr<BoxRows> rows);

    /// The whole box on one rank.
    explicit BoxStep(const BoxFluid& fluid);

    BoxStep(const BoxStep&) = delete;  // its readers refer to its values on the sides
    BoxStep& operator=(const BoxStep&) = delete;

    /// One component of u [m/s] over this rank's cells: set it before `project`; holds the result
    /// after `diffuse`.
    double* velocity(int axis) { return viscous_[axis].values(); }

    /// One component of u on the sides [m/s], where the boundary condition holds a value; zero
    /// unless set, and to be left zero on other sides. Holds until it is set again.
    SideValues& side_velocity(int axis) { return side_velocity_[axis]; }

    /// p over rho_f [m2/s2], up to a constant where no side fixes it; valid after `project`.
    double* pressure() { return own_pressure_.empty() ? pressure_.values() : own_pressure_.data(); }

    /// p gets an array of its own, zero at first, which no solve overwrites.
    void keep_pressure() { own_pressure_.assign(cells(), 0.0); }

    /// e on the faces normal to an axis [m/s] (box_layers.hpp). On the sides of the box, where e is
    /// not carried over, it is the flux minus the boundary value of u1.
    std::vector<double>& excess(int axis) { return excess_[axis]; }
    VelocityPointers excess_pointers();  ///< the same for all axes

    /// Step 1 over dt [s]: u becomes u1, and p, e and phi1 are set.
    FluxReport project(double dt);

    /// Step 2 over dt [s]: u1 becomes u2, explicitly, with the flux phi1. With `impulses` these are
    /// added, those of viscosity from u1.
    void transport(double dt, ImpulsesOfWindow* impulses = nullptr);

    /// A stage of step 2, and with viscosity of step 3, with the flux that is held; pieces are the
    /// components. Returns what crosses the sides by L(u), before it.
    BoxForce play(const VelocityStage& stage);

    /// u1 becomes u2 + f - dt G p, with the impulses of u1; ends step 2 of a window with impulses.
    void add_impulses(const VelocityStage::Values& u2, ImpulsesOfWindow& impulses);

    /// nu dt (4/hx2 + 4/hy2 + 4/hz2): the fastest decay by viscosity in dt [s].
    double fastest_decay(double dt) const;

    /// For transport in several sub-steps: keeps phi1 for all of them while u changes.
    void hold_flux();
    void release_flux() { held_.held = false; }

    /// The arrays of a flux that is not held, of no content; whoever takes them gives others back.
    FaceValues& idle_flux() { return held_.flux; }

    /// Holds, instead of phi1, the solenoidal flux nearest to S.u + e for transport over dt [s]; u
    /// and e stay as they are.
    FluxReport hold_solenoidal_flux(double dt);

    bool holds_flux() const { return held_.held; }

    /// k of step 1 for a window of length dt [s]: 1/(1 + 4 nu dt/h2), of the cells that are not
    /// stretched.
    double kept_excess(double dt) const {
        return 1.0 / (1.0 + 4.0 * fluid_.viscosity * dt / cell_area());
    }

    const BoxLayers& layers() const { return layers_; }
    BoxRows& rows() { return *rows_; }
    std::size_t cells() const { return layers_.cells(); }  ///< of this rank

    double viscosity() const { return fluid_.viscosity; }  ///< nu [m2/s]
    /// No side fixes p: what flows in is what flows out.
    bool is_closed() const { return fluid_.pressure.has_zero_mode(); }
    /// Of the cells that are not stretched [m2].
    double cell_area() const { return layers_.hx * fluid_.pressure.y.spacing; }
    /// The same, in the plane per unit length [m3].
    double cell_volume() const { return cell_area() * layers_.hz; }

    /// Differences on the same rows.
    BoxOperators operators() { return {fluid_.velocity, fluid_.pressure, *rows_, side_velocity_}; }

    /// The solver of p: values of -div/dt become p over rho_f.
    SeparableSolve& pressure_solve() { return pressure_; }

    // Second order in time transports with the flux of the window's middle, 3/2 phi1 - 1/2 of the
    // last window's phi1; where the run `begins`, with phi1.

    /// Step 1, which holds that flux.
    FluxReport project_and_hold_middle(double dt, bool begins);

    /// The same of hold_solenoidal_flux.
    FluxReport hold_solenoidal_middle(double dt, bool begins);

    /// phi1 of the last window over |S| on the faces normal to an axis, laid out like excess.
    std::vector<double>& last_flux(int axis) { return held_.last[axis]; }

    /// Step 3 over dt [s]: u2 becomes u3, implicitly. Calls `take(j)` when layer j is complete.
    void diffuse(double dt, const SeparableSolve::LayerWork& take);

    // side_forces.hpp:
    using Force = BoxForce;
    Force pressure_force();    ///< after `project`
    Force convective_force();  ///< after `project`, before `transport`
    Force viscous_force();     ///< after `diffuse`

 private:
    VelocityPointers velocity();
    VelocityStage::Values values_of_velocity();
    void begin_velocity(const VelocityStage::Values& u);
    void add_impulses(int j, ImpulsesOfWindow& impulses);
    void begin_impulses(ImpulsesOfWindow& impulses);
    template <class Find>
    FluxReport with_middle(bool begins, const Find& find);
    void add_side_velocity(double dt);
    BoxForce convective_force(const VelocityStage::Values& u);

    BoxFluid fluid_;
    std::unique_ptr<BoxRows> rows_;
    BoxLayers layers_;
    SeparableSolve pressure_;
    std::deque<SeparableSolve> viscous_;  // by component
    std::vector<double> own_pressure_;    // if kept
    double factorised_for_ = 0.0;
    FaceValues excess_;
    HeldFlux held_;
    VelocityOnSides side_velocity_;
    std::vector<RowReader> u_;  // by component
    RowReader p_;
    PressureProjection projection_;
    MomentumTransport transport_;
    SideForces forces_;
};

}  // namespace turbidite
