// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/box_app/interpolated_velocity.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite {

InterpolatedVelocity::InterpolatedVelocity(FluidField& field, BoxRows& rows,
                                           const VelocityOnSides& sides)
    : grid_(field.grid()),
      sides_(sides),
      first_(rows.first()),
      count_(rows.count()),
      u_(field.velocities()) {
    const std::size_t layer = static_cast<std::size_t>(grid_.counts[0]) * grid_.counts[2];
    std::vector<double> edges(4 * layer), beyond(4 * layer);
    for (int component = 0; component < 3; ++component) {
        auto to = edges.begin();
        // The edges that BoxRows::exchange asks for
        for (const int j : {0, 1, count_ - 2, count_ - 1})
            to = std::copy_n(u_[component] + j * layer, layer, to);
        rows.exchange(edges.data(), beyond.data());
        // Two layers below and two above; those next to the own ones are in the middle.
        outside_[component].assign(beyond.begin() + layer, beyond.begin() + 3 * layer);
    }
}

double InterpolatedVelocity::divergence(const CellIndex& at) const {
    double sum = 0.0;
    // Of the flux that steps have: S of box_step/row_heights.hpp weighs by volumes.
    for (int axis = 0; axis < 3; ++axis) sum += derivative(axis, axis, at, Weight::volume);
    return sum;
}

Vec3 InterpolatedVelocity::curl(const CellIndex& at) const {
    const auto d = [&](int component, int axis) {
        return derivative(component, axis, at, Weight::distance);
    };
    // (dw/dy - dv/dz, du/dz - dw/dx, dv/dx - du/dy)
    return {d(2, 1) - d(1, 2), d(0, 2) - d(2, 0), d(1, 0) - d(0, 1)};
}

double InterpolatedVelocity::derivative(int component, int axis, const CellIndex& at,
                                        Weight weight) const {
    // Gauss: the sum of value times area over both faces, over the volume
    return (on_face(component, axis, 1, at, weight) - on_face(component, axis, 0, at, weight)) /
           grid_.size(axis, at[axis]);
}

double InterpolatedVelocity::in_cell(int component, const CellIndex& at) const {
    const int nx = grid_.counts[0], nz = grid_.counts[2], own = at[1] - first_;
    const std::size_t place = at[0] + static_cast<std::size_t>(nx) * at[2],
                      layer = static_cast<std::size_t>(nx) * nz;
    if (own >= 0 && own < count_) return u_[component][place + layer * own];
    return outside_[component][place + (own < 0 ? 0 : layer)];
}

double InterpolatedVelocity::on_face(int component, int axis, int end, const CellIndex& at,
                                     Weight weight) const {
    CellIndex other = at;
    other[axis] += end == 0 ? -1 : 1;
    const double here = in_cell(component, at);
    const bool beyond = other[axis] < 0 || other[axis] >= grid_.counts[axis];
    const Side side = grid_.sides[axis][end];
    // No gradient on a free side; a wall or an inflow has the value it holds.
    if (beyond && side == Side::open) return here;
    if (beyond && side == Side::wall) return sides_[component][2 * axis + end][on_side(axis, at)];
    const int wrapped = grid_.wrapped(axis, other[axis]);
    double h = grid_.size(axis, at[axis]), h_other = grid_.size(axis, wrapped);
    // By volumes the larger cell counts for more; by distances the nearer, that is the smaller one.
    if (weight == Weight::distance) std::swap(h, h_other);
    // Beyond a cyclic end along y lie layers that were exchanged, if they are not the own ones.
    if (axis != 1) other[axis] = wrapped;
    return (h * here + h_other * in_cell(component, other)) / (h + h_other);
}

std::size_t InterpolatedVelocity::on_side(int axis, const CellIndex& at) const {
    const std::size_t nx = grid_.counts[0], nz = grid_.counts[2];
    if (axis == 0) return at[2] + nz * at[1];
    return axis == 1 ? at[0] + nx * at[2] : at[0] + nx * at[1];
}

double largest_divergence_of(FluidField& field, BoxRows& rows, const VelocityOnSides& sides) {
    const InterpolatedVelocity u(field, rows, sides);
    const CellGrid& grid = field.grid();
    double largest = 0.0;
    CellIndex at{};
    for (at[1] = rows.first(); at[1] < rows.first() + rows.count(); ++at[1])
        for (at[2] = 0; at[2] < grid.counts[2]; ++at[2])
            for (at[0] = 0; at[0] < grid.counts[0]; ++at[0])
                largest = std::max(largest, std::abs(u.divergence(at)));
    return largest;
}

}  // namespace turbidite
