// SPDX-License-Identifier: GPL-2.0-or-later
//
// Differences on the rows of a box, for what is solved with rigid grains in the fluid. With
// u, p at cell centres and G, D the central differences, and with d2 the second difference along
// one axis (h the spacing, sides as in row_reader.hpp):
//
//     G p    = (p_{+1} - p_{-1})/(2h)
//     D u    = sum over axes of (u_{+1} - u_{-1})/(2h)
//     L u    = sum over axes of d2 u/h2
//     flux   = S.u + e,    e = k e_old + dt (q_{+1} - q)/(4h) on the face between two cells,
//                          q = w d2 p
//     Q p    = sum over axes of d2 q/(4 h2)
//
// With w = 1 the flux is what the projection (box_step.hpp) leaves for this p: -D G p + Q p is
// minus the compact Laplacian. w = 0 in cells inside grains, where the fluid is rigid: faces
// between two such cells carry S.u and no more, and Q stays symmetric.
//
// Where rows have heights h_j of their own, along y with D of S.v and G of row_heights.hpp and s
// the slope of p between two rows: q = w h (s_{+1} - s), e = dt (q_{+1} - q)/(4d), and Q p is the
// divergence of e. All products are weighted by volumes: in them G and D, Q and L are symmetric.
//
// Each function reads and writes its arrays once, a row at a time; sums that the caller needs are
// taken while a row is in cache, and are those of this rank. Valid C++17.
#pragma once

#include <array>
#include <vector>

#include "fluid_adapter/box_step/row_differences.hpp"

namespace turbidite {

/// Components over a rank's rows, an array each: a kernel reads one at a time.
struct RowsOfTwo {
    std::vector<double> x, y;

    void resize(std::size_t size) { x.resize(size), y.resize(size); }
    std::vector<double>& operator[](int axis) { return axis == 0 ? x : y; }
    const std::vector<double>& operator[](int axis) const { return axis == 0 ? x : y; }
};

/// Of the image A d of a direction d.
struct ImageProducts {
    double direction = 0.0;  ///< with d, in the product the method uses
    double residual = 0.0;   ///< with r
    double itself = 0.0;
    double step = 0.0;  ///< of d with r, in the same product as `direction`

    static constexpr int count = 4;
    double* data() { return &direction; }
};
static_assert(sizeof(ImageProducts) == ImageProducts::count * sizeof(double));

/// Of a residual of viscosity, one component.
struct ViscousSums {
    double square = 0.0;  ///< r.r
    double sum = 0.0;     ///< of r
};

/// Both components of the excess flux of the last window, laid out as BoxStep::excess, of which the
/// part k remains on faces with a cell of w = 1, and nothing on others and on the sides of the box.
struct ExcessFlux {
    double *x, *y;
    double k = 1.0;
    const double* w;  ///< over the rank's cells
};

/// A change of velocity, u += share (x, y), still to be made by the kernel that next reads u.
struct PendingChange {
    double share = 0.0;
    const double *x = nullptr, *y = nullptr;
};

class BoxOperators {
 public:
    /// `rows` and the values on the sides, of both components, must outlive it.
    BoxOperators(const SeparableOperator& velocity, const SeparableOperator& pressure,
                 BoxRows& rows, const std::array<SideValues, 2>& sides);

    std::size_t size() const { return static_cast<std::size_t>(nx_) * ny_; }

    /// Sum over the rank's cells, weighted by volumes over those of cells that are not stretched.
    double sum_of_cells(const std::vector<double>& values) const;

    /// The same of a[c] b[c].
    double dot(const std::vector<double>& a, const std::vector<double>& b) const;

    /// The same of 1.
    double volume() const;

    // By every rank; arrays of this rank's rows. A velocity has the values that sides prescribe, a
    // change of a velocity is zero there.

    /// f = share L u, of the component of a velocity along `axis`
    void laplacian(double share, int axis, const double* u, double* f);

    /// x, y += sign (f - step G p), one component of f each
    void add_impulses(double sign, double step, const double* p, const RowsOfTwo& f, double* x,
                      double* y);

    /// x, y = -step G p
    void gradient(double step, const double* p, double* x, double* y);

    /// d = z + beta d, x, y = -step G d
    void direction(double step, const double* z, double beta, double* d, double* x, double* y);

    /// r = share L u - f, of the component of a velocity. `again`: a second copy of r.
    ViscousSums viscous_residual(double share, int axis, const double* u, const double* f,
                                 double* r, double* again);

    /// A d = d - share L v, of one component of v = W d, a change; its products with v, r, itself,
    /// and that of r with v. `image`: where it is kept, unless null.
    ImageProducts viscous_image(double share, int axis, const double* d, const double* v,
                                const double* r, double* image);

    /// r = -(D u + div e + step Q p) of a velocity, which is changed first; returns r.r
    double flux_residual(double step, const double* p, double* x, double* y,
                         const ExcessFlux& excess, const PendingChange& change, double* r);

    /// A d = D (x, y) + step Q d of a change of velocity; its products with d, r, itself, and that
    /// of r with d. `image`: where it is kept, unless null.
    ImageProducts flux_image(double step, const double* w, const double* d, const double* x,
                             const double* y, const double* r, double* image);

    /// e = what remains of it + step (q_{+1} - q)/(4h)
    void update_excess(double step, const double* p, const ExcessFlux& excess);

 private:
    using Row = std::vector<double>;

    RowDifferences differences() const { return {nx_, hx_, heights_}; }
    std::size_t at(int j) const { return static_cast<std::size_t>(j) * nx_; }
    std::size_t along(int j) const { return static_cast<std::size_t>(j) * (nx_ + 1); }
    void add_products(int j, const double* image, const double* d, const double* r,
                      ImageProducts& products) const;
    void gradient_rows(double step, double* x, double* y);
    void gradient_across(int j, double step, double* y);
    void divergence_of(int j, double share, RowReader& u, RowReader& v, double* out);
    void begin_velocity(double* x, double* y, const PendingChange& change);
    void kept_along(int j, const ExcessFlux& excess, double* face);
    void kept_across(int j, const ExcessFlux& excess, double* face);
    void begin_smoothing(const double* w, const double* p);
    void second_difference_along(int j);
    void second_difference_across(int j, Row& q);
    void add_smoothing(int j, double share, double* out);

    int nx_, ny_;
    double hx_;
    RowHeights heights_;
    bool periodic_;
    BoxRows& rows_;
    std::array<RowReader, 2> velocity_, change_;
    RowReader p_, w_;
    RowReader ends_;  // extends rows of q
    Row along_, below_, here_, above_, image_;
    Row face_along_, face_below_, face_above_;
};

}  // namespace turbidite
