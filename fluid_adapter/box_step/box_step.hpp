// SPDX-License-Identifier: GPL-2.0-or-later
//
// Steps 1 to 3 of a window on rows of a box, uniform or with rows of different heights
// (row_heights.hpp; Topin 2011, section 2.2), on contiguous arrays of the
// components of u, row by row (a row is all cells with the same y). The results equal those of
// OpenFOAM's operators (foam_app/operatorStep.hpp) to rounding:
//
//     1  projection   phi1 = S.u + k e - dt S.grad p,  div phi1 = 0,   u1 = u - dt grad p,
//                     e = phi1 - S.u1        k, e: foam_app/stokesProjection.hpp
//     2  transport    u2 = u1 - dt div(phi1 u1)                        convective_flux.hpp
//     3  viscosity    u3 - dt nu laplacian(u3) = u2
//
// Fluxes are face velocities: phi over |S|. The flux is not stored, but recomputed as e + S.u1,
// with two values of e per cell beside u and p; only transport in several sub-steps stores it. Each
// step reads and writes its fields once. Valid C++17.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "fluid_adapter/box_step/box_operators.hpp"
#include "fluid_adapter/box_step/convective_flux.hpp"
#include "fluid_adapter/box_step/row_heights.hpp"
#include "fluid_adapter/box_step/row_reader.hpp"
#include "fluid_adapter/box_step/row_work.hpp"
#include "fluid_adapter/box_step/velocity_stage.hpp"
#include "fluid_adapter/linear_solvers/separable_solve.hpp"

namespace turbidite {

struct BoxFluid {
    SeparableOperator velocity, pressure;  ///< grid, and the boundary conditions of u and p
    double viscosity = 0.0;                ///< nu [m2/s]
    double limiter = 1.0;                  ///< k of limitedLinearV (not the k of step 1)
    /// Share of linear interpolation where transport is not limited (convective_flux.hpp).
    std::optional<double> central;
    bool second_order = false;  ///< in time (second_order.hpp)
};

/// Of the projected flux phi1, over this rank's cells.
struct FluxReport {
    double divergence = 0.0;  ///< max |div phi1| [1/s]
    double courant = 0.0;     ///< largest Courant number, as OpenFOAM defines it
};

/// Impulses of viscosity and pressure, per mass, that a window begins with: f = dt nu L u and
/// -dt G p, with the p kept.
struct ImpulsesOfWindow {
    double dt = 0.0;                ///< [s]
    RowsOfTwo f;                    ///< [m/s]
    std::array<double, 2> sum_f{};  ///< over this rank's cells, weighted by volumes
};

class BoxStep {
 public:
    /// On this rank's rows of the box.
    BoxStep(const BoxFluid& fluid, std::unique_ptr<BoxRows> rows);

    /// The whole box on one rank.
    explicit BoxStep(const BoxFluid& fluid);

    BoxStep(const BoxStep&) = delete;  // its readers refer to its values on the sides
    BoxStep& operator=(const BoxStep&) = delete;

    /// One component of u [m/s], in rows of x.cells values: set it before `project`; holds the
    /// result after `diffuse`.
    double* velocity(int axis) { return viscous_[axis].values(); }

    /// One component of u on the sides [m/s], where the boundary condition holds a value; zero
    /// unless set, and to be left zero on other sides. Holds until it is set again.
    SideValues& side_velocity(int axis) { return side_velocity_[axis]; }

    /// p over rho_f [m2/s2], up to a constant where no side fixes it; valid after `project`.
    double* pressure() { return own_pressure_.empty() ? pressure_.values() : own_pressure_.data(); }

    /// p gets an array of its own, zero at first, which no solve overwrites.
    void keep_pressure() { own_pressure_.assign(static_cast<std::size_t>(nx_) * ny_, 0.0); }

    /// e on the faces normal to an axis [m/s]. Axis x: rows of x.cells + 1 values; axis y: rows of
    /// x.cells values, one row more than this rank has rows of cells. On the sides of the box,
    /// where e is not carried over, it is the flux minus the boundary value of u1.
    std::vector<double>& excess(int axis) { return excess_[axis]; }

    /// Step 1 over dt [s]: u becomes u1, and p, e and phi1 are set.
    FluxReport project(double dt);

    /// Step 2 over dt [s]: u1 becomes u2, explicitly, with the flux phi1. With `impulses` these are
    /// added, those of viscosity from u1.
    void transport(double dt, ImpulsesOfWindow* impulses = nullptr);

    /// A stage of step 2, and with viscosity of step 3, with the flux that is held; pieces are the
    /// components. Returns what crosses the sides by L(u), before it.
    std::array<double, 2> play(const VelocityStage& stage);

    /// u1 becomes u2 + f - dt G p, with the impulses of u1; ends step 2 of a window with impulses.
    void add_impulses(const VelocityStage::Values& u2, ImpulsesOfWindow& impulses);

    /// nu dt (4/hx2 + 4/hy2): the fastest decay by viscosity in dt [s].
    double fastest_decay(double dt) const;

    /// For transport in several sub-steps: keeps phi1 for all of them while u changes.
    void hold_flux();
    void release_flux() { held_ = false; }

    /// Holds, instead of phi1, the solenoidal flux nearest to S.u + e for transport over dt [s]; u
    /// and e stay as they are.
    FluxReport hold_solenoidal_flux(double dt);

    bool holds_flux() const { return held_; }

    /// k of step 1 for a window of length dt [s]: 1/(1 + 4 nu dt/h2), of the cells that are not
    /// stretched.
    double kept_excess(double dt) const {
        return 1.0 / (1.0 + 4.0 * fluid_.viscosity * dt / cell_area());
    }

    int columns() const { return nx_; }
    std::size_t cells() const { return static_cast<std::size_t>(nx_) * ny_; }  ///< of this rank

    double viscosity() const { return fluid_.viscosity; }  ///< nu [m2/s]
    /// Of the cells that are not stretched [m2].
    double cell_area() const { return hx_ * fluid_.pressure.y.spacing; }
    const RowHeights& heights() const { return heights_; }

    /// Differences on the same rows.
    BoxOperators operators() { return {fluid_.velocity, fluid_.pressure, *rows_, side_velocity_}; }

    /// The solver of p: values of -div/dt become p over rho_f.
    SeparableSolve& pressure_solve() { return pressure_; }

    // Second order in time transports with the flux of the window's middle, 3/2 phi1 - 1/2 of the
    // last window's phi1; where the run `begins`, with phi1.

    /// Step 1, which holds that flux.
    FluxReport project_and_hold_middle(double dt, bool begins);

    /// Instead of the flux that is held.
    void hold_middle_flux(bool begins);

    /// phi1 of the last window over |S| on the faces normal to an axis, laid out like excess.
    std::vector<double>& last_flux(int axis) { return last_flux_[axis]; }

    /// Step 3 over dt [s]: u2 becomes u3, implicitly. Calls `take(j)` when row j is complete.
    void diffuse(double dt, const SeparableSolve::LayerWork& take);

    // What crosses this rank's sides of the box: the rate of change of the fluid's momentum it
    // causes, over rho_f and per unit length out of the plane [m3/s2].
    using Force = std::array<double, 2>;
    Force pressure_force();    ///< after `project`
    Force convective_force();  ///< after `project`, before `transport`
    Force viscous_force();     ///< after `diffuse`

 private:
    using Row = std::vector<double>;

    void hold_middle(int axis, std::size_t first, int count, const double* flux);
    void begin_projection(double dt);
    FluxReport checked(double dt) const;
    void right_hand_side(int j, double dt);
    void correct_row(int j, double dt);
    void correct_across(int j, double dt, const double* p);
    void check_row(int j, const double* along, const double* below, const double* above);
    void correct_held_row(int j, double dt);
    void carry_above(int j);
    void carry_along(int j);
    void diffuse_between(int j);
    void transport_row(int j, double dt);
    void play_row(int j, const VelocityStage& stage);
    void begin_impulses(ImpulsesOfWindow& impulses);
    void add_impulses(int j, ImpulsesOfWindow& impulses);
    void carry(int count, const FacePlace& face, const double* flux, const AcrossFaces& u,
               const AcrossFaces& v, std::array<Row, 2>& carried) const;
    void flux_along(int j, const double* u, double kept, double* flux);
    void flux_across(int j, double kept, double* flux);
    void projected_across(int j, double dt, double* flux);
    double kept_on_row(int j) const;
    void add_side_velocity(double dt);
    double at_side(int axis, int side, int at) const { return side_velocity_[axis][side][at]; }
    template <class PerCell>
    Force over_sides(PerCell per_cell);
    Force convective_force(const double* u, const double* v);
    Force viscous_force(const double* u, const double* v);

    double* excess_x(int j) { return excess_[0].data() + static_cast<std::size_t>(j) * (nx_ + 1); }
    double* held_x(int j) { return flux_[0].data() + static_cast<std::size_t>(j) * (nx_ + 1); }
    double* held_y(int j) { return flux_[1].data() + static_cast<std::size_t>(j) * nx_; }
    double* excess_y(int j) { return excess_[1].data() + static_cast<std::size_t>(j) * nx_; }
    double* row_of(int axis, int j) { return velocity(axis) + static_cast<std::size_t>(j) * nx_; }

    BoxFluid fluid_;
    std::unique_ptr<BoxRows> rows_;
    int nx_, ny_;  // cells of this rank
    double hx_;
    RowHeights heights_;
    SeparableSolve pressure_;
    std::array<SeparableSolve, 2> viscous_;
    std::vector<double> own_pressure_;  // if kept
    double factorised_for_ = 0.0;
    double kept_ = 0.0;  // k of step 1 in this window
    std::array<std::vector<double>, 2> excess_;
    std::array<std::vector<double>, 2> flux_;       // phi1 over |S| if held, laid out like excess_
    std::array<std::vector<double>, 2> last_flux_;  // where second order asks for it
    bool held_ = false;
    std::optional<double> extrapolated_;  // by how many windows, while step 1 holds the flux
    std::array<SideValues, 2> side_velocity_;
    RowReader u_, v_, p_;
    Row flux_x_, flux_below_, flux_above_;
    Row corrected_u_, corrected_below_, corrected_here_, result_;
    std::array<Row, 2> carried_x_, carried_below_, carried_above_;
    Row largest_divergence_, largest_outflow_, divergence_;
};

}  // namespace turbidite
