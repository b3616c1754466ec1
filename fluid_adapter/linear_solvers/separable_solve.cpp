// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/linear_solvers/separable_solve.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace turbidite {
namespace {

const PlaneOperator& checked(const PlaneOperator& plane) {
    check(plane.x);
    check(plane.y);
    if (plane.x.stretched())
        throw std::invalid_argument("cells along x have different sizes; only rows may differ");
    return plane;
}

std::unique_ptr<Pencils> whole_grid(const PlaneOperator& plane) {
    return std::make_unique<WholeGrid>(plane.x.cells, plane.y.cells);
}

}  // namespace

SeparableSolve::SeparableSolve(const PlaneOperator& plane)
    : SeparableSolve(plane, whole_grid(checked(plane))) {}

SeparableSolve::SeparableSolve(const PlaneOperator& plane, std::unique_ptr<Pencils> pencils)
    : pencils_(std::move(pencils)),
      columns_of_grid_(plane.x.cells),
      transform_(checked(plane).x),
      columns_(plane.x, plane.y, {pencils_->first_mode(), pencils_->mode_count()}),
      zero_mode_(plane.x.has_zero_mode() && plane.y.has_zero_mode()) {}

void SeparableSolve::factorise(const Helmholtz& problem) {
    columns_.factorise(problem, transform_.normalisation());
    free_constants_ = zero_mode_ && problem.alpha == 0.0;
}

/// Fills and transforms rows in pairs; calls done(j) after the transform of row j.
template <class Done>
void SeparableSolve::forward(const RowWork& fill, Done done) {
    const int rows = pencils_->row_count();
    for (int j = 0; j < rows; j += 2) {
        const bool pair = j + 1 < rows;
        fill(j);
        if (pair) fill(j + 1);
        transform_.forward(row(j), pair ? row(j + 1) : nullptr);
        done(j);
        if (pair) done(j + 1);
    }
}

/// Transforms back in pairs, from the last row down; ready(j) must complete the modes of rows j and
/// above.
template <class Ready>
void SeparableSolve::backward(Ready ready, const RowWork& take) {
    for (int j = pencils_->row_count() - 1; j >= 0; j -= 2) {
        const bool pair = j > 0;
        ready(pair ? j - 1 : j);
        transform_.backward(row(j), pair ? row(j - 1) : nullptr);
        take(j);
        if (pair) take(j - 1);
    }
}

double SeparableSolve::solve() {
    const RowWork nothing = [](int) {};
    return solve(nothing, nothing);
}

double SeparableSolve::solve(const RowWork& fill, const RowWork& take) {
    const auto none = [](int) {};
    if (!pencils_->in_place()) {
        forward(fill, none);
        pencils_->to_columns();
        const double taken = columns_.solve(pencils_->columns());
        pencils_->to_rows();
        backward(none, take);
        return free_constants_ ? pencils_->from_mode_zero(taken) : 0.0;
    }
    double* values = pencils_->columns();
    forward(fill, [&](int j) { columns_.up(j, values); });
    const double taken = columns_.turn(values);
    int next = pencils_->row_count() - 1;  // next row on the way down
    const auto complete = [&](int j) {
        for (; next >= std::max(j - 1, 0); --next) columns_.down(next, values);
    };
    backward(complete, take);
    return taken;
}

}  // namespace turbidite
