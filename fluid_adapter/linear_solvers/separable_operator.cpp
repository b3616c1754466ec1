// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/linear_solvers/separable_operator.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace turbidite {
namespace {

using std::numbers::pi;

/// Contribution of the mirror image beyond an end to the diagonal, in units of 1/h2.
double end_share(End end) {
    return end == End::neumann ? -1.0 : end == End::dirichlet ? 1.0 : 0.0;
}

/// Phase of mode k over the doubled (mirrored) or single (periodic) axis.
double phase(const AxisOperator& axis, int k) {
    if (axis.periodic()) return pi * k / axis.cells;
    const double shift =
        0.5 * (axis.lower == End::dirichlet) + 0.5 * (axis.upper == End::dirichlet);
    // s of mu_k: 0, 1/2 or 1, by the number of dirichlet ends
    return pi * (k + shift) / (2.0 * axis.cells);
}

/// (1/d_{j-1} + 1/d_j)/h_j; a dirichlet end is at half a cell from the centre.
double stretched_diagonal(const AxisOperator& axis, int j) {
    const double h = axis.size(j);
    const auto at_end = [&](End end) { return end == End::dirichlet ? 2.0 / h : 0.0; };
    const double below = j > 0 ? 1.0 / axis.distance(j - 1) : at_end(axis.lower);
    const double above = j + 1 < axis.cells ? 1.0 / axis.distance(j) : at_end(axis.upper);
    return (below + above) / h;
}

void check_sizes(const AxisOperator& axis) {
    if (!axis.stretched()) return;
    if (static_cast<int>(axis.sizes.size()) != axis.cells)
        throw std::invalid_argument(std::to_string(axis.sizes.size()) +
                                    " cell sizes for an axis of " + std::to_string(axis.cells) +
                                    " cells");
    for (const double size : axis.sizes)
        if (!(size > 0.0) || !std::isfinite(size))
            throw std::invalid_argument("a cell of length " + std::to_string(size) +
                                        "; it must be positive and finite");
    if (axis.periodic()) throw std::invalid_argument("a stretched axis cannot be periodic");
}

}  // namespace

double AxisOperator::diagonal(int j) const {
    if (stretched()) return stretched_diagonal(*this, j);
    double share = 2.0;
    if (j == 0) share += end_share(lower);
    if (j == cells - 1) share += end_share(upper);
    return share * coupling();
}

double AxisOperator::eigenvalue(int k) const {
    const double sine = std::sin(phase(*this, k));
    return 4.0 * sine * sine * coupling();  // (4/h2) sin2(phase)
}

void check(const AxisOperator& axis) {
    if (axis.cells < 3)
        throw std::invalid_argument("an axis of " + std::to_string(axis.cells) +
                                    " cells; a separable solve needs 3 or more");
    if (!(axis.spacing > 0.0) || !std::isfinite(axis.spacing))
        throw std::invalid_argument("cells of length " + std::to_string(axis.spacing) +
                                    "; it must be positive and finite");
    if ((axis.lower == End::periodic) != (axis.upper == End::periodic))
        throw std::invalid_argument("one end of an axis is periodic and the other is not");
    check_sizes(axis);
}

void check(const SeparableOperator& grid) {
    check(grid.x);
    check(grid.y);
    if (grid.in_space()) check(grid.z);
    if (grid.x.stretched() || grid.z.stretched())
        throw std::invalid_argument("cells along x have different sizes; only rows may differ");
}

}  // namespace turbidite
