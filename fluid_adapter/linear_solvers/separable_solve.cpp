// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/linear_solvers/separable_solve.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace turbidite {
namespace {

const SeparableOperator& checked(const SeparableOperator& grid) {
    check(grid);
    return grid;
}

}  // namespace

SeparableSolve::SeparableSolve(const SeparableOperator& grid)
    : SeparableSolve(grid, std::make_unique<WholeGrid>(checked(grid).layer(), grid.y.cells)) {}

SeparableSolve::SeparableSolve(const SeparableOperator& grid, std::unique_ptr<Pencils> pencils)
    : pencils_(std::move(pencils)),
      cells_of_layer_(grid.layer()),
      transform_(checked(grid)),
      columns_(grid, {pencils_->first_mode(), pencils_->mode_count()}),
      zero_mode_(grid.has_zero_mode()) {}

void SeparableSolve::factorise(const Helmholtz& problem) {
    columns_.factorise(problem, transform_.normalisation());
    free_constants_ = zero_mode_ && problem.alpha == 0.0;
}

/// Fills and transforms layers; calls done(j) after the transform of layer j.
template <class Done>
void SeparableSolve::forward(const LayerWork& fill, Done done) {
    const int layers = pencils_->row_count();
    for (int first = 0; first < layers; first += transform_.together()) {
        const int end = std::min(first + transform_.together(), layers);
        for (int j = first; j < end; ++j) fill(j);
        transform_.forward(layer(first), end - first);
        for (int j = first; j < end; ++j) done(j);
    }
}

/// Transforms back from the last layer down; ready(j) must complete the modes of layers j and
/// above.
template <class Ready>
void SeparableSolve::backward(Ready ready, const LayerWork& take) {
    for (int last = pencils_->row_count() - 1; last >= 0; last -= transform_.together()) {
        const int first = std::max(last - transform_.together() + 1, 0);
        ready(first);
        transform_.backward(layer(first), last - first + 1);
        for (int j = last; j >= first; --j) take(j);
    }
}

double SeparableSolve::solve() {
    const LayerWork nothing = [](int) {};
    return solve(nothing, nothing);
}

double SeparableSolve::solve(const LayerWork& fill, const LayerWork& take) {
    const auto none = [](int) {};
    if (!pencils_->in_place()) {
        // Elimination needs the modes of all layers: a transpose before and one after it.
        forward(fill, none);
        pencils_->to_columns();
        const double taken = columns_.solve(pencils_->columns());
        pencils_->to_rows();
        backward(none, take);
        // Only the rank with mode 0 knows the mean.
        return free_constants_ ? pencils_->from_mode_zero(taken) : 0.0;
    }
    double* values = pencils_->columns();
    // On one rank elimination goes up with the transforms, and down with those back.
    forward(fill, [&](int j) { columns_.up(j, values); });
    const double taken = columns_.turn(values);
    int next = pencils_->row_count() - 1;  // next layer on the way down
    const auto complete = [&](int j) {
        // down(j - 1) completes layer j, and down(0) also layer 0.
        for (; next >= std::max(j - 1, 0); --next) columns_.down(next, values);
    };
    backward(complete, take);
    return taken;
}

}  // namespace turbidite
