// SPDX-License-Identifier: GPL-2.0-or-later
//
// Differences on the rows of a uniform box, for what is solved with rigid grains in the fluid. With
// u, p at cell centres and G, D the central differences, and with d2 the second difference along
// one axis (h the spacing, sides as in row_reader.hpp):
//
//     G p    = (p_{+1} - p_{-1})/(2h)
//     D u    = sum over axes of (u_{+1} - u_{-1})/(2h)
//     L u    = sum over axes of d2 u/h2
//     flux   = S.u + e,    e = k e_old + dt (q_{+1} - q)/(4h) on the face between two cells,
//                          q = w d2 p
//
// With w = 1 the flux is what the projection (box_step.hpp) leaves for this p: D S.G p plus the
// part of e is the compact Laplacian. w = 0 in cells inside grains, where the fluid is rigid: faces
// between two such cells carry S.u and no more, and the operator stays symmetric. Valid C++17.
#pragma once

#include <array>
#include <vector>

#include "fluid_adapter/box_step/row_reader.hpp"

namespace turbidite {

/// Components over a rank's rows.
struct RowsOfTwo {
    std::vector<double> x, y;

    void resize(std::size_t size) { x.resize(size), y.resize(size); }
};

/// A velocity has the values that sides prescribe; a change of one is zero there.
enum class SidesHold { velocity, nothing };

class BoxOperators {
 public:
    /// `rows` and the values on the sides, of both components, must outlive it.
    BoxOperators(const PlaneOperator& velocity, const PlaneOperator& pressure, BoxRows& rows,
                 const std::array<SideValues, 2>& sides);

    std::size_t size() const { return static_cast<std::size_t>(nx_) * ny_; }

    // By every rank; arrays of this rank's rows.

    /// x, y -= step G p
    void subtract_gradient(double step, const double* p, double* x, double* y);

    /// out = share L u, of the component along `axis`
    void laplacian(double share, int axis, SidesHold sides, const double* u, double* out);

    /// out = share D (x, y)
    void divergence(double share, SidesHold sides, const double* x, const double* y, double* out);

    /// out += share div e, with e laid out as BoxStep::excess
    void add_divergence_of_excess(double share, const double* along_x, const double* along_y,
                                  double* out) const;

    /// out += share sum over axes of d2 (w d2 p)/(4 h2)
    void add_smoothing(double share, const double* w, const double* p, double* out);

    /// e = k e, on faces with a cell of w = 1; 0 on others and on the sides of the box
    void keep_excess(double k, const double* w, double* along_x, double* along_y);

    /// e += step (q_{+1} - q)/(4h)
    void add_to_excess(double step, const double* w, const double* p, double* along_x,
                       double* along_y);

 private:
    using Row = std::vector<double>;

    std::array<RowReader, 2>& readers(SidesHold sides) {
        return sides == SidesHold::velocity ? velocity_ : change_;
    }
    std::size_t at(int j) const { return static_cast<std::size_t>(j) * nx_; }
    void second_difference_along(int j, const double* w, Row& q);
    void second_difference_across(int j, const double* w, Row& q);
    void begin_smoothing(const double* w, const double* p);

    int nx_, ny_;
    double hx_, hy_;
    bool periodic_;
    BoxRows& rows_;
    std::array<RowReader, 2> velocity_, change_;
    RowReader p_, w_;
    RowReader ends_;  // extends rows of q
    Row along_, below_, here_, above_;
};

}  // namespace turbidite
