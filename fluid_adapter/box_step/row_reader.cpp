// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/row_reader.hpp"

#include <algorithm>
#include <utility>

namespace turbidite {

double mirrored(End end) {
    return end == End::dirichlet ? -1.0 : 1.0;
}

RowReader::RowReader(const SeparableOperator& plane, BoxRows& rows, const SideValues* sides)
    : plane_(plane),
      rows_(rows),
      sides_(sides),
      edges_(static_cast<std::size_t>(2 * beyond) * plane.x.cells),
      outside_(edges_.size()),
      slots_(static_cast<std::size_t>(kept) * (plane.x.cells + padding)) {}

void RowReader::begin(const double* values) {
    begin(values, nullptr);
}

/// Rows at the edges are changed at once: their images and the other ranks need them.
void RowReader::begin(const double* values, Change change) {
    for (int j = 0; change && j < rows_.count(); ++j)
        if (at_edge(j)) change(j);
    values_ = values;
    change_ = std::move(change);
    loaded_ = -beyond - 1;
    look_outside(values);
}

void RowReader::look_outside(const double* values) {
    const std::size_t nx = plane_.x.cells;
    std::copy_n(values, beyond * nx, edges_.begin());
    std::copy_n(values + (rows_.count() - beyond) * nx, beyond * nx, edges_.begin() + beyond * nx);
    rows_.exchange(edges_.data(), outside_.data());
    // Rows in edges: first, second, last but one, last; in outside: -2, -1, n, n + 1.
    if (!rows_.open_below()) {
        mirror(0, 1, 2);
        mirror(1, 0, 2);
    }
    if (!rows_.open_above()) {
        mirror(3, 2, 3);
        mirror(2, 3, 3);
    }
}

/// Fills row `to` of outside with the image of row `from` of edges beyond side 2 (bottom) or 3.
void RowReader::mirror(int from, int to, int side) {
    const std::size_t nx = plane_.x.cells;
    const double factor = mirrored(side == 2 ? plane_.y.lower : plane_.y.upper);
    for (std::size_t i = 0; i < nx; ++i) outside_[to * nx + i] = factor * edges_[from * nx + i];
    for (std::size_t i = 0; sides_ && i < nx; ++i)
        outside_[to * nx + i] += 2.0 * (*sides_)[side][i];
}

/// Of side 0 (left) or 1, beside row j.
double RowReader::on_side(int side, int j) const {
    const bool own = sides_ && j >= 0 && j < rows_.count();
    return own ? (*sides_)[side][j] : 0.0;
}

void RowReader::load(int j) {
    const int nx = plane_.x.cells, ny = rows_.count();
    if (change_ && !at_edge(j)) change_(j);
    const double* from = j < 0 ? outside_.data() + static_cast<std::size_t>(beyond + j) * nx
                         : j >= ny
                             ? outside_.data() + static_cast<std::size_t>(beyond + j - ny) * nx
                             : values_ + static_cast<std::size_t>(j) * nx;
    double* row =
        slots_.data() + static_cast<std::size_t>((j + beyond) % kept) * (nx + padding) + beyond;
    std::copy_n(from, nx, row);
    extend(row, j);
}

void RowReader::extend(double* row, int j) const {
    const int nx = plane_.x.cells;
    if (plane_.x.periodic()) {
        row[-1] = row[nx - 1];
        row[-2] = row[nx - 2];
        row[nx] = row[0];
        row[nx + 1] = row[1];
        return;
    }
    const double left = mirrored(plane_.x.lower), right = mirrored(plane_.x.upper);
    const double twice_left = 2.0 * on_side(0, j), twice_right = 2.0 * on_side(1, j);
    row[-1] = left * row[0] + twice_left;
    row[-2] = left * row[1] + twice_left;
    row[nx] = right * row[nx - 1] + twice_right;
    row[nx + 1] = right * row[nx - 2] + twice_right;
}

const double* RowReader::row(int j) {
    while (loaded_ < j) load(++loaded_);
    const std::size_t slot = (j + beyond) % kept;
    return slots_.data() + slot * (plane_.x.cells + padding) + beyond;
}

}  // namespace turbidite
