// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/row_reader.hpp"

#include <algorithm>

namespace turbidite {

double mirrored(End end) {
    return end == End::dirichlet ? -1.0 : 1.0;
}

RowReader::RowReader(const PlaneOperator& plane)
    : plane_(plane),
      borders_(static_cast<std::size_t>(2 * beyond) * plane.x.cells),
      slots_(static_cast<std::size_t>(kept) * (plane.x.cells + padding)) {}

void RowReader::begin(const double* values) {
    values_ = values;
    loaded_ = -beyond - 1;
    const std::size_t nx = plane_.x.cells;
    std::copy_n(values, beyond * nx, borders_.begin());
    std::copy_n(values + (plane_.y.cells - beyond) * nx, beyond * nx,
                borders_.begin() + beyond * nx);
}

/// Where row j of the field, or what stands for it, is.
const double* RowReader::source(int j, double& factor) const {
    const int nx = plane_.x.cells, ny = plane_.y.cells;
    factor = 1.0;
    if (j >= 0 && j < ny) return values_ + static_cast<std::size_t>(j) * nx;
    int border;  // of the rows kept: first, second, last but one, last
    if (plane_.y.periodic()) {
        border = j < 0 ? 2 * beyond + j : j - ny;
    } else {
        factor = mirrored(j < 0 ? plane_.y.lower : plane_.y.upper);
        border = j < 0 ? -1 - j : 2 * beyond - 1 - (j - ny);
    }
    return borders_.data() + static_cast<std::size_t>(border) * nx;
}

void RowReader::load(int j) {
    const int nx = plane_.x.cells;
    double* row =
        slots_.data() + static_cast<std::size_t>((j + beyond) % kept) * (nx + padding) + beyond;
    double factor;
    const double* from = source(j, factor);
    if (factor == 1.0)
        std::copy_n(from, nx, row);
    else
        for (int i = 0; i < nx; ++i) row[i] = factor * from[i];
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
