// SPDX-License-Identifier: GPL-2.0-or-later
//
// The reference of `ours_over_array_code`: the cost of a window without grains in a code written by
// hand for this one purpose. A closed box with no-slip walls, flat arrays, one core, FFTW; no
// OpenFOAM and no code of Turbidite. It computes the same numbers as Turbidite's fluid (a test
// compares them), by the same splitting on the same collocated grid:
//
//     1  w = S.u + k e;  lap p = div w/dt;  w -= dt dp/dn;  u -= dt grad p;  e = w - S.u
//     2  u -= dt div(w u_f)              u_f: limitedLinear, one limiter for both components
//     3  (1 - nu dt lap) u = u           one solve per component
//
// w: face velocities, e: their excess over the mean S.u of the cells, k = 1/(1 + 4 nu dt/h2).
//
// Omitted, as a code written for one purpose would omit them: checks (finiteness, divergence,
// momentum balance, Courant number), and everything that reads a case or writes a file.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "bench/array_code/box_solve.hpp"

namespace turbidite::array_code {

struct FlowSetup {
    int nx = 0, ny = 0;
    double spacing = 0.0;    ///< h [m]
    double viscosity = 0.0;  ///< nu [m2/s]
    double step = 0.0;       ///< dt [s]
};

/// (u, v) at a point [m/s].
using VelocityAt = std::function<std::pair<double, double>(double x, double y)>;

class PlaneFlow {
 public:
    PlaneFlow(const FlowSetup& setup, const VelocityAt& start);

    void step();

    double u(int i, int j) const { return u_.cell(i, j); }
    double v(int i, int j) const { return v_.cell(i, j); }

    /// Memory of all arrays.
    std::size_t bytes() const;

 private:
    /// One value per cell, with one row of ghosts below and above, and ghosts left and right.
    class Field {
     public:
        explicit Field(const FlowSetup& setup);
        double* row(int j) { return first_ + j * stride_; }
        const double* row(int j) const { return first_ + j * stride_; }
        double cell(int i, int j) const { return row(j)[i]; }
        std::ptrdiff_t stride() const { return stride_; }
        std::size_t bytes() const { return size_ * sizeof(double); }

     private:
        struct Release {
            void operator()(double* values) const { fftw_free(values); }
        };
        std::ptrdiff_t stride_;
        std::size_t size_;
        std::unique_ptr<double[], Release> values_;
        double* first_;
    };

    /// Momentum flux through the faces of a row [m2/s2].
    struct FaceFlux {
        std::vector<double> u, v;
    };

    void fill_ghosts(Field& field, double sign) const;
    void face_velocity_and_divergence();
    void correct_cells();
    void transport();
    void flux_across(int j);
    void flux_above(int j);

    FlowSetup setup_;
    Field u_, v_, p_, moved_u_, moved_v_;
    Field wx_, wy_;  // e between windows, w within; [i]: left and upper face of cell i
    FaceFlux left_, above_, below_;
    BoxSolve pressure_, viscosity_;
};

}  // namespace turbidite::array_code
