// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_solver/boxInverse.hpp"

namespace turbidite {
namespace {

bool same(const AxisOperator& a, const AxisOperator& b) {
    return a.cells == b.cells && a.spacing == b.spacing && a.lower == b.lower &&
           a.upper == b.upper && a.sizes == b.sizes;
}

bool same(const SeparableOperator& a, const SeparableOperator& b) {
    return same(a.x, b.x) && same(a.y, b.y);
}

bool same(const Helmholtz& a, const Helmholtz& b) {
    return a.alpha == b.alpha && a.beta == b.beta;
}

}  // namespace

void BoxInverse::set(const BoxOperator& to) {
    // Plans and arrays depend on the plane alone, factors on alpha and beta too: a matrix that has
    // kept its coefficients costs neither.
    const bool new_plane = !solve_ || !same(operator_.plane, to.plane);
    if (new_plane) solve_ = std::make_unique<SeparableSolve>(to.plane, rows_.pencils());
    if (new_plane || !same(operator_.problem, to.problem)) solve_->factorise(to.problem);
    operator_ = to;
}

/// The value at the reference cell, on the rank whose rows contain it; null on the others.
double* BoxInverse::reference_value() const {
    const Span& rows = rows_.rows_of_rank()[box_.ranks.rank()];
    const int place = operator_.reference - rows.first * box_.cells[0];
    return place >= 0 && place < rows.count * box_.cells[0] ? solve_->values() + place : nullptr;
}

/// Equations per volume, where rows have different heights.
void BoxInverse::divide_by_height(double* values) const {
    if (!operator_.plane.y.stretched()) return;
    const Span& rows = rows_.rows_of_rank()[box_.ranks.rank()];
    for (int j = 0; j < rows.count; ++j)
        for (int i = 0; i < box_.cells[0]; ++i)
            values[static_cast<std::size_t>(j) * box_.cells[0] + i] /=
                operator_.height(rows.first + j);
}

void BoxInverse::apply(const Foam::solveScalarField& r, Foam::solveScalarField& x) {
    double* values = solve_->values();
    // s A x = s r: the operator is that of the matrix times its sign.
    rows_.gather([&](int c) { return operator_.sign * r[c]; }, values);
    double level = 0.0;
    if (operator_.reference < 0) {
        divide_by_height(values);
        solve_->solve();
    } else {
        double sum = 0.0;
        // sum r = delta x_ref
        for (const double value : r) sum += operator_.sign * value;
        box_.ranks.sum(&sum, 1);
        double* at_reference = reference_value();
        // L x = r - (sum r) e, whose right-hand side sums to zero
        if (at_reference) *at_reference -= sum;
        divide_by_height(values);
        solve_->solve();
        // x_ref = (sum r)/delta; known on one rank, zero on the others.
        level = at_reference ? sum / operator_.stiffening - *at_reference : 0.0;
        box_.ranks.sum(&level, 1);
    }
    rows_.scatter(values, [&](int c, double value) { x[c] = value + level; });
}

}  // namespace turbidite
