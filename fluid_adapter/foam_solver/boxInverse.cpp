// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_solver/boxInverse.hpp"

namespace turbidite {
namespace {

bool same(const AxisOperator& a, const AxisOperator& b) {
    return a.cells == b.cells && a.spacing == b.spacing && a.lower == b.lower && a.upper == b.upper;
}

bool same(const PlaneOperator& a, const PlaneOperator& b) {
    return same(a.x, b.x) && same(a.y, b.y);
}

bool same(const Helmholtz& a, const Helmholtz& b) {
    return a.alpha == b.alpha && a.beta == b.beta;
}

}  // namespace

void BoxInverse::set(const BoxOperator& to) {
    const bool new_plane = !solve_ || !same(operator_.plane, to.plane);
    if (new_plane) solve_ = std::make_unique<SeparableSolve>(to.plane);
    if (new_plane || !same(operator_.problem, to.problem)) solve_->factorise(to.problem);
    operator_ = to;
}

void BoxInverse::apply(const BoxNumbering& box, const Foam::solveScalarField& r,
                       Foam::solveScalarField& x) {
    double* values = solve_->values();
    double sum = 0.0;
    forAll(r, c) {
        values[box.place[c]] = operator_.sign * r[c];
        sum += operator_.sign * r[c];
    }
    const bool held = operator_.reference >= 0;
    if (held) values[operator_.reference] -= sum;
    solve_->solve();
    const double level = held ? sum / operator_.stiffening - values[operator_.reference] : 0.0;
    forAll(x, c) x[c] = values[box.place[c]] + level;
}

}  // namespace turbidite
