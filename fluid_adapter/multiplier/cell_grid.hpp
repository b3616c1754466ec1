// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A rectilinear grid of cells, described by numbers alone: the cell (i, j, k) that contains a
// position is computed or found by bisection, never by scanning all cells. In two dimensions the
// third axis has one cell. A layer is all cells with the same index along an axis. Layers are
// equally thick or, on a stretched axis, lie between given edges; rules that count lengths in cells
// then use the sizes of the cells at hand. Valid C++17.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace turbidite {

/// Layers along an axis, which may lie beyond a cyclic side.
struct LayerSpan {
    int low, high;
    bool cut;  ///< to one turn of a cyclic axis
};

/// Boundary type at one end of an axis.
enum class Side { wall, open, cyclic };

struct CellGrid {
    int dimension = 2;
    std::array<double, 3> origin{};  ///< lower corner of cell (0, 0, 0) [m]
    std::array<double, 3>
        spacing{};  ///< cell size along each axis; the mean on a stretched one [m]
    std::array<int, 3> counts{1, 1, 1};
    std::array<std::array<Side, 2>, 3> sides{};  ///< [axis][lower, upper]
    /// Ascending cell edges of a stretched axis, one more than it has cells [m]; empty for a
    /// uniform axis.
    std::array<std::vector<double>, 3> edges{};

    /// Makes an axis stretched, with the given cell edges [m].
    void stretch(int axis, const std::vector<double>& ends) {
        edges[axis] = ends;
        counts[axis] = static_cast<int>(ends.size()) - 1;
        origin[axis] = ends.front();
        spacing[axis] = (ends.back() - ends.front()) / counts[axis];
    }

    bool stretched(int axis) const { return !edges[axis].empty(); }
    bool cyclic(int axis) const { return sides[axis][0] == Side::cyclic; }
    double length(int axis) const { return counts[axis] * spacing[axis]; }

    /// Coordinate of the centre of layer i [m]; i may lie outside a cyclic grid.
    double centre(int axis, int i) const {
        if (!stretched(axis)) return origin[axis] + (i + 0.5) * spacing[axis];
        const int turns = turns_of(axis, i), at = i - turns * counts[axis];
        return turns * length(axis) + 0.5 * (edges[axis][at] + edges[axis][at + 1]);
    }

    /// Thickness of layer i [m]; i may lie outside a cyclic grid.
    double size(int axis, int i) const {
        if (!stretched(axis)) return spacing[axis];
        const int at = i - turns_of(axis, i) * counts[axis];
        return edges[axis][at + 1] - edges[axis][at];
    }

    /// V_c over the volume of the reference cell, whose edges are `spacing`; exactly 1 in a uniform
    /// grid.
    double relative_volume(int i, int j) const { return relative_size(0, i) * relative_size(1, j); }

    /// Index of the layer that contains a coordinate; may lie outside the grid.
    int layer(int axis, double coordinate) const {
        if (!stretched(axis))
            return static_cast<int>(std::floor((coordinate - origin[axis]) / spacing[axis]));
        const double turns =
            cyclic(axis) ? std::floor((coordinate - origin[axis]) / length(axis)) : 0.0;
        const std::vector<double>& ends = edges[axis];
        const auto above =
            std::upper_bound(ends.begin(), ends.end(), coordinate - turns * length(axis));
        return static_cast<int>(above - ends.begin()) - 1 + static_cast<int>(turns) * counts[axis];
    }

    /// Index of the last layer whose centre lies at or below a coordinate; may lie outside the
    /// grid.
    int layer_below(int axis, double coordinate) const {
        if (!stretched(axis))
            return static_cast<int>(std::floor((coordinate - origin[axis]) / spacing[axis] - 0.5));
        const int i = layer(axis, coordinate);
        const bool inside = cyclic(axis) || (i >= 0 && i < counts[axis]);
        return inside && coordinate >= centre(axis, i) ? i : i - 1;
    }

    /// The layers within `reach` of a coordinate; of what reaches round a cyclic axis one turn,
    /// those up to half a period away, else its first and last layers would be the same cells.
    LayerSpan layers_within(int axis, double at, double reach) const {
        LayerSpan span{layer(axis, at - reach), layer(axis, at + reach), false};
        const int turn = counts[axis];
        if (!cyclic(axis) || span.high - span.low < turn) return span;
        span.low = layer_below(axis, at - 0.5 * length(axis)) + 1;
        span.high = span.low + turn - 1;
        span.cut = true;
        return span;
    }

    /// Layer index wrapped into a cyclic grid; -1 outside a bounded one.
    int wrapped(int axis, int i) const {
        const int n = counts[axis];
        if (i >= 0 && i < n) return i;
        if (!cyclic(axis)) return -1;
        return ((i % n) + n) % n;
    }

    /// The shortest periodic image of a difference of positions.
    Eigen::Vector3d nearest_image(Eigen::Vector3d difference) const {
        for (int axis = 0; axis < dimension; ++axis)
            if (cyclic(axis))
                difference[axis] -= length(axis) * std::round(difference[axis] / length(axis));
        return difference;
    }

    /// The longest cell edge within `reach` of a position [m].
    double largest_size(const Eigen::Vector3d& place, double reach) const {
        double h = 0.0;
        for (int axis = 0; axis < dimension; ++axis) {
            if (!stretched(axis)) h = std::max(h, spacing[axis]);
            if (!stretched(axis)) continue;
            const int low = layer(axis, place[axis] - reach),
                      high = layer(axis, place[axis] + reach);
            for (int i = low; i <= high; ++i)
                if (wrapped(axis, i) >= 0) h = std::max(h, size(axis, i));
        }
        return h;
    }

 private:
    double relative_size(int axis, int i) const {
        return stretched(axis) ? size(axis, i) / spacing[axis] : 1.0;
    }

    /// How many times a layer index has gone round a cyclic axis.
    int turns_of(int axis, int i) const {
        const int n = counts[axis];
        return i >= 0 ? i / n : -((n - 1 - i) / n);
    }
};

}  // namespace turbidite
