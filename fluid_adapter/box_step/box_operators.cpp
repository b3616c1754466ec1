// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/box_operators.hpp"

#include <algorithm>

#include "fluid_adapter/box_step/row_work.hpp"

namespace turbidite {
namespace {

/// The grid of a plane, with values that sides leave alone.
PlaneOperator even(PlaneOperator plane) {
    for (AxisOperator* axis : {&plane.x, &plane.y})
        if (!axis->periodic()) axis->lower = axis->upper = End::neumann;
    return plane;
}

}  // namespace

BoxOperators::BoxOperators(const PlaneOperator& velocity, const PlaneOperator& pressure,
                           BoxRows& rows, const std::array<SideValues, 2>& sides)
    : nx_(pressure.x.cells),
      ny_(rows.count()),
      hx_(pressure.x.spacing),
      hy_(pressure.y.spacing),
      periodic_(pressure.x.periodic()),
      rows_(rows),
      velocity_{RowReader(velocity, rows, &sides[0]), RowReader(velocity, rows, &sides[1])},
      change_{RowReader(velocity, rows), RowReader(velocity, rows)},
      p_(pressure, rows),
      w_(even(pressure), rows),
      ends_(pressure, rows) {
    along_.resize(nx_ + RowReader::padding);
    for (Row* row : {&below_, &here_, &above_}) row->resize(nx_);
}

void BoxOperators::subtract_gradient(double step, const double* p, double* x, double* y) {
    p_.begin(p);
    for (int j = 0; j < ny_; ++j) {
        const double* below = p_.row(j - 1);
        const double* here = p_.row(j);
        const double* above = p_.row(j + 1);
        correct(nx_, 0.5 * step / hx_, here - 1, here + 1, x + at(j), x + at(j));
        correct(nx_, 0.5 * step / hy_, below, above, y + at(j), y + at(j));
    }
}

void BoxOperators::laplacian(double share, int axis, SidesHold sides, const double* u,
                             double* out) {
    RowReader& rows = readers(sides)[axis];
    rows.begin(u);
    for (int j = 0; j < ny_; ++j) {
        const double* below = rows.row(j - 1);
        const double* here = rows.row(j);
        laplacian_row(nx_, share / (hx_ * hx_), share / (hy_ * hy_), below, here, rows.row(j + 1),
                      out + at(j));
    }
}

void BoxOperators::divergence(double share, SidesHold sides, const double* x, const double* y,
                              double* out) {
    auto& [u, v] = readers(sides);
    u.begin(x);
    v.begin(y);
    for (int j = 0; j < ny_; ++j) {
        const double* here = u.row(j);
        const double* below = v.row(j - 1);
        divergence_row(nx_, 0.5 * share / hx_, here - 1, here + 1, 0.5 * share / hy_, below,
                       v.row(j + 1), out + at(j));
    }
}

void BoxOperators::add_divergence_of_excess(double share, const double* along_x,
                                            const double* along_y, double* out) const {
    for (int j = 0; j < ny_; ++j) {
        const double* left = along_x + static_cast<std::size_t>(j) * (nx_ + 1);
        add_divergence_row(nx_, share / hx_, left, left + 1, share / hy_, along_y + at(j),
                           along_y + at(j + 1), out + at(j));
    }
}

void BoxOperators::begin_smoothing(const double* w, const double* p) {
    w_.begin(w);
    p_.begin(p);
    second_difference_across(-1, w_.row(-1), below_);
    second_difference_across(0, w_.row(0), here_);
}

/// q = w d2 p along x, extended beyond both ends as p is.
void BoxOperators::second_difference_along(int j, const double* w, Row& q) {
    const double* p = p_.row(j);
    double* inside = q.data() + RowReader::beyond;
    weighted_difference(nx_, w, p - 1, p, p + 1, inside);
    ends_.extend(inside, j);
}

/// q = w d2 p along y.
void BoxOperators::second_difference_across(int j, const double* w, Row& q) {
    const double* below = p_.row(j - 1);
    const double* here = p_.row(j);
    weighted_difference(nx_, w, below, here, p_.row(j + 1), q.data());
}

void BoxOperators::add_smoothing(double share, const double* w, const double* p, double* out) {
    begin_smoothing(w, p);
    const double x = 0.25 * share / (hx_ * hx_), y = 0.25 * share / (hy_ * hy_);
    const double* q = along_.data() + RowReader::beyond;
    for (int j = 0; j < ny_; ++j) {
        second_difference_along(j, w_.row(j), along_);
        second_difference_across(j + 1, w_.row(j + 1), above_);
        add_differences(nx_, x, q - 1, q, q + 1, y, below_.data(), here_.data(), above_.data(),
                        out + at(j));
        below_.swap(here_);
        here_.swap(above_);
    }
}

void BoxOperators::keep_excess(double k, const double* w, double* along_x, double* along_y) {
    w_.begin(w);
    for (int j = 0; j <= ny_; ++j) {
        const double* here = w_.row(j);
        const double* below = w_.row(j - 1);
        const bool side = (j == 0 && !rows_.open_below()) || (j == ny_ && !rows_.open_above());
        double* across = along_y + at(j);
        for (int i = 0; i < nx_; ++i) across[i] *= side ? 0.0 : k * std::max(below[i], here[i]);
        if (j == ny_) break;
        double* along = along_x + static_cast<std::size_t>(j) * (nx_ + 1);
        for (int i = 0; i <= nx_; ++i) along[i] *= k * std::max(here[i - 1], here[i]);
        if (!periodic_) along[0] = along[nx_] = 0.0;
    }
}

void BoxOperators::add_to_excess(double step, const double* w, const double* p, double* along_x,
                                 double* along_y) {
    begin_smoothing(w, p);
    const double x = 0.25 * step / hx_, y = 0.25 * step / hy_;
    const double* q = along_.data() + RowReader::beyond;
    for (int j = 0; j <= ny_; ++j) {
        double* across = along_y + at(j);
        correct(nx_, -y, below_.data(), here_.data(), across, across);
        if (j == ny_) break;
        second_difference_along(j, w_.row(j), along_);
        second_difference_across(j + 1, w_.row(j + 1), above_);
        double* along = along_x + static_cast<std::size_t>(j) * (nx_ + 1);
        correct(nx_ + 1, -x, q - 1, q, along, along);
        below_.swap(here_);
        here_.swap(above_);
    }
}

}  // namespace turbidite
