// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/row_reader.hpp"

#include <algorithm>

namespace turbidite {

double mirrored(End end) {
    return end == End::dirichlet ? -1.0 : 1.0;
}

RowReader::RowReader(const PlaneOperator& plane, BoxRows& rows)
    : plane_(plane),
      rows_(rows),
      edges_(static_cast<std::size_t>(2 * beyond) * plane.x.cells),
      outside_(edges_.size()),
      slots_(static_cast<std::size_t>(kept) * (plane.x.cells + padding)) {}

void RowReader::begin(const double* values) {
    values_ = values;
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
        mirror(0, 1, plane_.y.lower);
        mirror(1, 0, plane_.y.lower);
    }
    if (!rows_.open_above()) {
        mirror(3, 2, plane_.y.upper);
        mirror(2, 3, plane_.y.upper);
    }
}

/// Fills row `to` of outside with the mirror image of row `from` of edges.
void RowReader::mirror(int from, int to, End end) {
    const std::size_t nx = plane_.x.cells;
    const double factor = mirrored(end);
    for (std::size_t i = 0; i < nx; ++i) outside_[to * nx + i] = factor * edges_[from * nx + i];
}

void RowReader::load(int j) {
    const int nx = plane_.x.cells, ny = rows_.count();
    const double* from = j < 0 ? outside_.data() + static_cast<std::size_t>(beyond + j) * nx
                         : j >= ny
                             ? outside_.data() + static_cast<std::size_t>(beyond + j - ny) * nx
                             : values_ + static_cast<std::size_t>(j) * nx;
    double* row =
        slots_.data() + static_cast<std::size_t>((j + beyond) % kept) * (nx + padding) + beyond;
    std::copy_n(from, nx, row);
    extend(row);
}

void RowReader::extend(double* row) const {
    const int nx = plane_.x.cells;
    if (plane_.x.periodic()) {
        row[-1] = row[nx - 1];
        row[-2] = row[nx - 2];
        row[nx] = row[0];
        row[nx + 1] = row[1];
        return;
    }
    const double left = mirrored(plane_.x.lower), right = mirrored(plane_.x.upper);
    row[-1] = left * row[0];
    row[-2] = left * row[1];
    row[nx] = right * row[nx - 1];
    row[nx + 1] = right * row[nx - 2];
}

const double* RowReader::row(int j) {
    while (loaded_ < j) load(++loaded_);
    const std::size_t slot = (j + beyond) % kept;
    return slots_.data() + slot * (plane_.x.cells + padding) + beyond;
}

}  // namespace turbidite
