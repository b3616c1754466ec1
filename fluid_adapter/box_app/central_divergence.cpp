// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/box_app/central_divergence.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace turbidite {
namespace {

/// One component of u, with the layers of other ranks next to this rank's.
class Neighbours {
 public:
    Neighbours(FluidField& field, BoxRows& rows, const VelocityOnSides& sides)
        : grid_(field.grid()), rows_(rows), sides_(sides), u_(field.velocities()) {
        const std::size_t layer = static_cast<std::size_t>(grid_.counts[0]) * grid_.counts[2];
        std::vector<double> edges;
        for (const int j : {0, 1, rows.count() - 2, rows.count() - 1})
            edges.insert(edges.end(), u_[1] + j * layer, u_[1] + (j + 1) * layer);
        outside_.resize(edges.size());
        rows.exchange(edges.data(), outside_.data());
    }

    double divergence(int i, int j, int k) const {
        return flux(0, i, j, k) / grid_.size(0, i) + flux(1, i, j, k) / grid_.size(1, j) +
               flux(2, i, j, k) / grid_.size(2, k);
    }

 private:
    double at(int axis, int i, int j, int k) const {
        const int nx = grid_.counts[0], nz = grid_.counts[2], own = j - rows_.first();
        const int place = i + nx * k;
        if (own >= 0 && own < rows_.count()) return u_[axis][place + nx * nz * own];
        return outside_[place + nx * nz * (own < 0 ? 1 : 2)];  // next to the own ones
    }

    /// Through both faces across the axis.
    double flux(int axis, int i, int j, int k) const {
        return face(axis, 1, i, j, k) - face(axis, 0, i, j, k);
    }

    double face(int axis, int end, int i, int j, int k) const {
        std::array<int, 3> other{i, j, k};
        other[axis] += end == 0 ? -1 : 1;
        const double here = at(axis, i, j, k);
        const bool beyond = other[axis] < 0 || other[axis] >= grid_.counts[axis];
        const Side side = grid_.sides[axis][end];
        if (beyond && side == Side::open) return here;
        if (beyond && side == Side::wall)
            return sides_[axis][2 * axis + end][on_side(axis, i, j, k)];
        const int wrapped = grid_.wrapped(axis, other[axis]);
        const int index = std::array<int, 3>{i, j, k}[axis];
        const double h = grid_.size(axis, index), h_other = grid_.size(axis, wrapped);
        // Beyond a cyclic end along y lie layers that were exchanged, if they are not the own ones.
        if (axis != 1) other[axis] = wrapped;
        const double there = at(axis, other[0], other[1], other[2]);
        return (h * here + h_other * there) / (h + h_other);
    }

    std::size_t on_side(int axis, int i, int j, int k) const {
        const std::size_t nx = grid_.counts[0], nz = grid_.counts[2];
        if (axis == 0) return k + nz * j;
        return axis == 1 ? i + nx * k : i + nx * j;
    }

    const CellGrid& grid_;
    BoxRows& rows_;
    const VelocityOnSides& sides_;
    VelocityPointers u_;
    std::vector<double> outside_;
};

}  // namespace

double largest_central_divergence(FluidField& field, BoxRows& rows, const VelocityOnSides& sides) {
    const Neighbours u(field, rows, sides);
    const CellGrid& grid = field.grid();
    double largest = 0.0;
    for (int j = rows.first(); j < rows.first() + rows.count(); ++j)
        for (int k = 0; k < grid.counts[2]; ++k)
            for (int i = 0; i < grid.counts[0]; ++i)
                largest = std::max(largest, std::abs(u.divergence(i, j, k)));
    return largest;
}

}  // namespace turbidite
