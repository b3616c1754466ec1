// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/linear_solvers/separable_solve.hpp"

#include <utility>

namespace turbidite {
namespace {

const PlaneOperator& checked(const PlaneOperator& plane) {
    check(plane.x);
    check(plane.y);
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
      transform_(checked(plane).x, pencils_->row_count(), pencils_->rows()),
      columns_(plane.x, plane.y, {pencils_->first_mode(), pencils_->mode_count()}),
      zero_mode_(plane.x.has_zero_mode() && plane.y.has_zero_mode()) {}

void SeparableSolve::factorise(const Helmholtz& problem) {
    columns_.factorise(problem, transform_.normalisation());
    free_constants_ = zero_mode_ && problem.alpha == 0.0;
}

double SeparableSolve::solve() {
    transform_.forward();
    pencils_->to_columns();
    const double taken = columns_.solve(pencils_->columns());
    pencils_->to_rows();
    transform_.backward();
    return free_constants_ ? pencils_->from_mode_zero(taken) : 0.0;
}

}  // namespace turbidite
