// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/row_reader.hpp"

#include <algorithm>
#include <utility>

namespace turbidite {

double mirrored(End end) {
    return end == End::dirichlet ? -1.0 : 1.0;
}

RowReader::RowReader(const SeparableOperator& grid, BoxRows& rows, const SideValues* sides)
    : grid_(grid),
      rows_(rows),
      sides_(sides),
      edges_(static_cast<std::size_t>(2 * beyond) * grid.layer()),
      outside_(edges_.size()),
      slots_(kept, PaddedLayer(grid.x.cells, grid.z.cells)) {}

void RowReader::begin(const double* values) {
    begin(values, nullptr);
}

/// Layers at the edges are changed at once: their images and the other ranks need them.
void RowReader::begin(const double* values, Change change) {
    for (int j = 0; change && j < rows_.count(); ++j)
        if (at_edge(j)) change(j);
    values_ = values;
    change_ = std::move(change);
    loaded_ = -beyond - 1;
    look_outside(values);
}

void RowReader::look_outside(const double* values) {
    const std::size_t two_layers = static_cast<std::size_t>(beyond) * grid_.layer();
    const std::size_t size = static_cast<std::size_t>(rows_.count()) * grid_.layer();
    std::copy_n(values, two_layers, edges_.begin());
    std::copy_n(values + size - two_layers, two_layers, edges_.begin() + two_layers);
    rows_.exchange(edges_.data(), outside_.data());
    // Layers in edges: first, second, last but one, last; in outside: -2, -1, n, n + 1.
    if (!rows_.open_below()) {
        mirror(0, 1, 2);
        mirror(1, 0, 2);
    }
    if (!rows_.open_above()) {
        mirror(3, 2, 3);
        mirror(2, 3, 3);
    }
}

/// Fills layer `to` of outside with the image of layer `from` of edges beyond side 2 (bottom) or 3.
void RowReader::mirror(int from, int to, int side) {
    const std::size_t n = grid_.layer();
    // The image of row 0 is row -1, that of row 1 row -2; at the top alike.
    const double factor = mirrored(side == 2 ? grid_.y.lower : grid_.y.upper);
    for (std::size_t i = 0; i < n; ++i) outside_[to * n + i] = factor * edges_[from * n + i];
    for (std::size_t i = 0; sides_ && i < n; ++i) outside_[to * n + i] += 2.0 * (*sides_)[side][i];
}

/// Of side 0 (left) or 1, beside row k of layer j.
double RowReader::on_side(int side, int j, int k) const {
    return sides_ && own(j) ? (*sides_)[side][k + grid_.z.cells * j] : 0.0;
}

void RowReader::load(int j) {
    const int nx = grid_.x.cells, ny = rows_.count();
    // Layers at the edges were changed by `begin`.
    if (change_ && !at_edge(j)) change_(j);
    // -2, -1, n, n + 1 are 0, 1, 2, 3 of outside.
    const std::size_t outside = j < 0 ? beyond + j : beyond + j - ny;
    const double* from = own(j) ? values_ + static_cast<std::size_t>(j) * grid_.layer()
                                : outside_.data() + outside * grid_.layer();
    // The slot of layer j - kept, which is no longer valid
    PaddedLayer& layer = slots_[(j + beyond) % kept];
    for (int k = 0; k < grid_.z.cells; ++k) {
        std::copy_n(from + static_cast<std::size_t>(k) * nx, nx, layer.row(k));
        extend(layer.row(k), j, k);
    }
    extend(layer, j);
}

void RowReader::extend(double* row, int j, int k) const {
    const int nx = grid_.x.cells;
    if (grid_.x.periodic()) {
        row[-1] = row[nx - 1];
        row[-2] = row[nx - 2];
        row[nx] = row[0];
        row[nx + 1] = row[1];
        return;
    }
    // u_{-1} = f u_0 + 2 u_b, u_{-2} = f u_1 + 2 u_b with f = +-1 (side_values.hpp)
    const double left = mirrored(grid_.x.lower), right = mirrored(grid_.x.upper);
    const double twice_left = 2.0 * on_side(0, j, k), twice_right = 2.0 * on_side(1, j, k);
    row[-1] = left * row[0] + twice_left;
    row[-2] = left * row[1] + twice_left;
    row[nx] = right * row[nx - 1] + twice_right;
    row[nx + 1] = right * row[nx - 2] + twice_right;
}

void RowReader::extend(PaddedLayer& layer, int j) const {
    const int nx = grid_.x.cells, nz = grid_.z.cells;
    if (!grid_.in_space()) return;
    if (!grid_.z.periodic()) {
        for (int k = 0; k < beyond; ++k) {
            add_image(layer, k, -1 - k, 4, j);
            add_image(layer, nz - 1 - k, nz + k, 5, j);
        }
        return;
    }
    for (int k = 0; k < beyond; ++k) {
        std::copy_n(layer.row(nz - 1 - k), nx, layer.row(-1 - k));
        std::copy_n(layer.row(k), nx, layer.row(nz + k));
    }
}

/// Fills row `to` with the image of row `from` beyond side 4 or 5.
void RowReader::add_image(PaddedLayer& layer, int from, int to, int side, int j) const {
    const int nx = grid_.x.cells;
    const double factor = mirrored(side == 4 ? grid_.z.lower : grid_.z.upper);
    const double* inside = layer.row(from);
    double* image = layer.row(to);
    for (int i = 0; i < nx; ++i) image[i] = factor * inside[i];
    if (!sides_ || !own(j)) return;
    const double* held = (*sides_)[side].data() + static_cast<std::size_t>(nx) * j;
    for (int i = 0; i < nx; ++i) image[i] += 2.0 * held[i];
}

}  // namespace turbidite
