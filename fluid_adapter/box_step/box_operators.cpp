// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/box_operators.hpp"

#include <algorithm>
#include <numeric>

#include "fluid_adapter/box_step/row_work.hpp"

namespace turbidite {
namespace {

/// The grid of a plane, with values that sides leave alone.
SeparableOperator even(SeparableOperator plane) {
    for (AxisOperator* axis : {&plane.x, &plane.y})
        if (!axis->periodic()) axis->lower = axis->upper = End::neumann;
    return plane;
}

}  // namespace

BoxOperators::BoxOperators(const SeparableOperator& velocity, const SeparableOperator& pressure,
                           BoxRows& rows, const std::array<SideValues, 2>& sides)
    : nx_(pressure.x.cells),
      ny_(rows.count()),
      hx_(pressure.x.spacing),
      heights_(pressure.y, rows),
      periodic_(pressure.x.periodic()),
      rows_(rows),
      velocity_{RowReader(velocity, rows, &sides[0]), RowReader(velocity, rows, &sides[1])},
      change_{RowReader(velocity, rows), RowReader(velocity, rows)},
      p_(pressure, rows),
      w_(even(pressure), rows),
      ends_(pressure, rows) {
    along_.resize(nx_ + RowReader::padding);
    face_along_.resize(nx_ + 1);
    for (Row* row : {&below_, &here_, &above_, &image_, &face_below_, &face_above_})
        row->resize(nx_);
}

double BoxOperators::sum_of_cells(const std::vector<double>& values) const {
    if (!heights_.stretched()) return std::accumulate(values.begin(), values.end(), 0.0);
    double sum = 0.0;
    for (int j = 0; j < ny_; ++j)
        sum += heights_.relative(j) *
               std::accumulate(values.begin() + at(j), values.begin() + at(j + 1), 0.0);
    return sum;
}

double BoxOperators::dot(const std::vector<double>& a, const std::vector<double>& b) const {
    double sum = 0.0;
    for (int j = 0; j < ny_; ++j)
        sum += heights_.relative(j) * dot_row(nx_, a.data() + at(j), b.data() + at(j));
    return sum;
}

double BoxOperators::volume() const {
    double sum = 0.0;
    for (int j = 0; j < ny_; ++j) sum += heights_.relative(j) * nx_;
    return sum;
}

/// Of row j, whose rows these are.
void BoxOperators::add_products(int j, const double* image, const double* d, const double* r,
                                ImageProducts& products) const {
    const double volume = heights_.relative(j);
    products.direction += volume * dot_row(nx_, image, d);
    products.residual += volume * dot_row(nx_, image, r);
    products.itself += volume * dot_row(nx_, image, image);
    products.step += volume * dot_row(nx_, r, d);
}

void BoxOperators::laplacian(double share, int axis, const double* u, double* f) {
    RowReader& rows = velocity_[axis];
    rows.begin(u);
    for (int j = 0; j < ny_; ++j) differences().laplacian(j, share, rows, f + at(j));
}

void BoxOperators::add_impulses(double sign, double step, const double* p, const RowsOfTwo& f,
                                double* x, double* y) {
    p_.begin(p);
    for (int j = 0; j < ny_; ++j) {
        const double* here = p_.row(j);
        add_row(nx_, sign, f.x.data() + at(j), x + at(j));
        add_row(nx_, sign, f.y.data() + at(j), y + at(j));
        correct(nx_, 0.5 * sign * step / hx_, here - 1, here + 1, x + at(j), x + at(j));
        differences().correct_across(j, sign * step, p_, y + at(j), y + at(j));
    }
}

void BoxOperators::gradient(double step, const double* p, double* x, double* y) {
    p_.begin(p);
    gradient_rows(step, x, y);
}

void BoxOperators::direction(double step, const double* z, double beta, double* d, double* x,
                             double* y) {
    p_.begin(d, [this, z, beta, d](int j) { next_direction(nx_, z + at(j), beta, d + at(j)); });
    gradient_rows(step, x, y);
}

/// x, y = -step G of what p_ reads.
void BoxOperators::gradient_rows(double step, double* x, double* y) {
    for (int j = 0; j < ny_; ++j) {
        const double* here = p_.row(j);
        difference_row(nx_, -0.5 * step / hx_, here - 1, here + 1, x + at(j));
        gradient_across(j, step, y + at(j));
    }
}

/// y = -step G along y of row j of what p_ reads.
void BoxOperators::gradient_across(int j, double step, double* y) {
    std::fill_n(y, nx_, 0.0);
    differences().correct_across(j, step, p_, y, y);
}

ViscousSums BoxOperators::viscous_residual(double share, int axis, const double* u, const double* f,
                                           double* r, double* again) {
    RowReader& rows = velocity_[axis];
    rows.begin(u);
    ViscousSums sums;
    for (int j = 0; j < ny_; ++j) {
        differences().laplacian(j, share, rows, r + at(j));
        add_row(nx_, -1.0, f + at(j), r + at(j));
        std::copy_n(r + at(j), nx_, again + at(j));
        sums.square += heights_.relative(j) * dot_row(nx_, r + at(j), r + at(j));
        sums.sum += heights_.relative(j) * sum_row(nx_, r + at(j));
    }
    return sums;
}

ImageProducts BoxOperators::viscous_image(double share, int axis, const double* d, const double* v,
                                          const double* r, double* image) {
    RowReader& rows = change_[axis];
    rows.begin(v);
    ImageProducts products;
    for (int j = 0; j < ny_; ++j) {
        double* out = image ? image + at(j) : image_.data();
        differences().laplacian(j, -share, rows, out);
        add_row(nx_, 1.0, d + at(j), out);
        add_products(j, out, rows.row(j), r + at(j), products);
    }
    return products;
}

/// out = share D (u, v) of row j.
void BoxOperators::divergence_of(int j, double share, RowReader& u, RowReader& v, double* out) {
    const double* here = u.row(j);
    const double* below = v.row(j - 1);
    const double* across = v.row(j);
    const double* above = v.row(j + 1);
    central_divergence_row(nx_, 0.5 * share / hx_, here - 1, here + 1,
                           heights_.central_difference(j, share), below, across, above, out);
}

double BoxOperators::flux_residual(double step, const double* p, double* x, double* y,
                                   const ExcessFlux& excess, const PendingChange& change,
                                   double* r) {
    begin_velocity(x, y, change);
    begin_smoothing(excess.w, p);
    kept_across(0, excess, face_below_.data());
    double sum = 0.0;
    for (int j = 0; j < ny_; ++j) {
        double* out = r + at(j);
        divergence_of(j, -1.0, velocity_[0], velocity_[1], out);
        kept_along(j, excess, face_along_.data());
        kept_across(j + 1, excess, face_above_.data());
        add_divergence_row(nx_, -1.0 / hx_, face_along_.data(), face_along_.data() + 1,
                           -1.0 / heights_.size(j), face_below_.data(), face_above_.data(), out);
        face_below_.swap(face_above_);
        add_smoothing(j, -step, out);
        sum += heights_.relative(j) * dot_row(nx_, out, out);
    }
    return sum;
}

void BoxOperators::begin_velocity(double* x, double* y, const PendingChange& change) {
    if (change.share == 0.0) {
        velocity_[0].begin(x);
        velocity_[1].begin(y);
        return;
    }
    const auto made = [&](double* u, const double* by) {
        return [this, u, by, share = change.share](int j) {
            add_row(nx_, share, by + at(j), u + at(j));
        };
    };
    velocity_[0].begin(x, made(x, change.x));
    velocity_[1].begin(y, made(y, change.y));
}

/// What remains of e on the x faces of row j, whose w has been read.
void BoxOperators::kept_along(int j, const ExcessFlux& excess, double* face) {
    const double* w = w_.row(j);
    kept_row(nx_ + 1, excess.k, w - 1, w, excess.x + along(j), face);
    if (!periodic_) face[0] = face[nx_] = 0.0;
}

/// What remains of e on the faces below row j.
void BoxOperators::kept_across(int j, const ExcessFlux& excess, double* face) {
    const bool side = (j == 0 && !rows_.open_below()) || (j == ny_ && !rows_.open_above());
    const double* below = w_.row(j - 1);
    kept_row(nx_, side ? 0.0 : excess.k, below, w_.row(j), excess.y + at(j), face);
}

ImageProducts BoxOperators::flux_image(double step, const double* w, const double* d,
                                       const double* x, const double* y, const double* r,
                                       double* image) {
    change_[0].begin(x);
    change_[1].begin(y);
    begin_smoothing(w, d);
    ImageProducts products;
    for (int j = 0; j < ny_; ++j) {
        double* out = image ? image + at(j) : image_.data();
        divergence_of(j, 1.0, change_[0], change_[1], out);
        add_smoothing(j, step, out);
        add_products(j, out, d + at(j), r + at(j), products);
    }
    return products;
}

void BoxOperators::begin_smoothing(const double* w, const double* p) {
    w_.begin(w);
    p_.begin(p);
    second_difference_across(-1, below_);
    second_difference_across(0, here_);
}

/// along = w d2 p along x of row j, extended beyond both ends as p is.
void BoxOperators::second_difference_along(int j) {
    const double* p = p_.row(j);
    double* inside = along_.data() + RowReader::beyond;
    weighted_difference(nx_, ones, w_.row(j), p - 1, p, p + 1, inside);
    ends_.extend(inside, j);
}

/// q along y of row j.
void BoxOperators::second_difference_across(int j, Row& q) {
    const double* below = p_.row(j - 1);
    const double* here = p_.row(j);
    const double* above = p_.row(j + 1);
    weighted_difference(nx_, heights_.over_distances(j, heights_.size(j)), w_.row(j), below, here,
                        above, q.data());
}

/// out += share Q p of row j; rows in ascending order.
void BoxOperators::add_smoothing(int j, double share, double* out) {
    const double x = 0.25 * share / (hx_ * hx_);
    const RowShares y = heights_.over_volumes(j, 0.25 * share);
    const double* q = along_.data() + RowReader::beyond;
    second_difference_along(j);
    second_difference_across(j + 1, above_);
    add_differences(nx_, x, q - 1, q, q + 1, y, below_.data(), here_.data(), above_.data(), out);
    below_.swap(here_);
    here_.swap(above_);
}

void BoxOperators::update_excess(double step, const double* p, const ExcessFlux& excess) {
    begin_smoothing(excess.w, p);
    const double x = 0.25 * step / hx_;
    const double* q = along_.data() + RowReader::beyond;
    for (int j = 0; j <= ny_; ++j) {
        double* across = excess.y + at(j);
        const double y = 0.25 * step / heights_.distance(j);
        kept_across(j, excess, across);
        correct(nx_, -y, below_.data(), here_.data(), across, across);
        if (j == ny_) break;
        second_difference_along(j);
        second_difference_across(j + 1, above_);
        double* left = excess.x + along(j);
        kept_along(j, excess, left);
        correct(nx_ + 1, -x, q - 1, q, left, left);
        below_.swap(here_);
        here_.swap(above_);
    }
}

}  // namespace turbidite
