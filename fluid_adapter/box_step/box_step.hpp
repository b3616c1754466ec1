// SPDX-License-Identifier: GPL-2.0-or-later
//
// Steps 1 to 3 of a window on a uniform box (Topin 2011, section 2.2), on contiguous components of
// u, row by row. The same numbers as OpenFOAM's operators (foam_app/operatorStep.hpp) to rounding:
//
//     1  projection   phi1 = S.u + k e - dt S.grad p,  div phi1 = 0,   u1 = u - dt grad p,
//                     e = phi1 - S.u1        k, e: foam_app/stokesProjection.hpp
//     2  transport    u2 = u1 - dt div(phi1 u1)                        convective_flux.hpp
//     3  viscosity    u3 - dt nu laplacian(u3) = u2
//
// Fluxes are face velocities: phi over |S|. The flux itself is never stored: it is e + S.u1, two
// values per cell, beside u and p; only transport in several parts keeps it. Each step reads and
// writes its fields once. Valid C++17.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "fluid_adapter/box_step/row_reader.hpp"
#include "fluid_adapter/linear_solvers/separable_solve.hpp"

namespace turbidite {

struct BoxFluid {
    PlaneOperator velocity, pressure;  ///< grid, and the conditions of u and p
    double viscosity = 0.0;            ///< nu [m2/s]
    double limiter = 1.0;              ///< k of limitedLinearV
};

/// Of the projected flux, over this rank's cells.
struct FluxReport {
    double divergence = 0.0;  ///< max |div phi1| [1/s]
    double courant = 0.0;     ///< largest, as OpenFOAM defines it
};

class BoxStep {
 public:
    /// On this rank's rows of the box.
    BoxStep(const BoxFluid& fluid, std::unique_ptr<BoxRows> rows);

    /// The whole box on one rank.
    explicit BoxStep(const BoxFluid& fluid);

    /// One component of u, rows of x.cells values [m/s]: given before `project`, result after
    /// `diffuse`.
    double* velocity(int axis) { return viscous_[axis].values(); }

    /// p over rho_f [m2/s2], known up to a constant where no side fixes it; after `project`.
    double* pressure() { return pressure_.values(); }

    /// e on the faces across an axis [m/s]: x, rows of x.cells + 1; y, rows of x.cells, one more
    /// than this rank has rows of cells. On the sides of the box, where nothing is remembered, what
    /// the flux has beyond the boundary value of u1.
    std::vector<double>& excess(int axis) { return excess_[axis]; }

    FluxReport project(double dt);

    void transport(double dt);

    /// For transport in several parts: between the two, phi1 is kept while u changes.
    void hold_flux();
    void release_flux() { held_ = false; }

    /// `take(j)` is called once row j is complete.
    void diffuse(double dt, const SeparableSolve::RowWork& take);

    // What crosses the sides of the box that this rank has, over rho_f and per unit length out of
    // the plane [m3/s2]: the rate at which the fluid's momentum changes by it.
    using Force = std::array<double, 2>;
    Force pressure_force();    ///< after `project`
    Force convective_force();  ///< after `project`, before `transport`
    Force viscous_force();     ///< after `diffuse`

 private:
    using Row = std::vector<double>;

    void right_hand_side(int j, double dt);
    void correct_row(int j, double dt);
    void correct_across(int j, double dt, const double* p);
    void check_row();
    void carry_above(int j);
    void transport_row(int j, double dt);
    void flux_along(int j, const double* u, double kept, double* flux);
    double kept_on_row(int j) const;
    template <class PerCell>
    Force over_sides(PerCell per_cell);

    double* excess_x(int j) { return excess_[0].data() + static_cast<std::size_t>(j) * (nx_ + 1); }
    double* held_x(int j) { return flux_[0].data() + static_cast<std::size_t>(j) * (nx_ + 1); }
    double* held_y(int j) { return flux_[1].data() + static_cast<std::size_t>(j) * nx_; }
    double* excess_y(int j) { return excess_[1].data() + static_cast<std::size_t>(j) * nx_; }
    double* row_of(int axis, int j) { return velocity(axis) + static_cast<std::size_t>(j) * nx_; }

    BoxFluid fluid_;
    std::unique_ptr<BoxRows> rows_;
    int nx_, ny_;  // of this rank
    double hx_, hy_;
    SeparableSolve pressure_;
    std::array<SeparableSolve, 2> viscous_;
    double factorised_for_ = 0.0;
    double kept_ = 0.0;  // k of this window
    std::array<std::vector<double>, 2> excess_;
    std::array<std::vector<double>, 2> flux_;  // phi1 over |S|, where it was held; like excess_
    bool held_ = false;
    RowReader u_, v_, p_;
    Row flux_x_, flux_below_, flux_above_;
    Row corrected_u_, corrected_below_, corrected_here_;
    std::array<Row, 2> carried_x_, carried_below_, carried_above_;
    Row largest_divergence_, largest_outflow_, divergence_;
};

}  // namespace turbidite
