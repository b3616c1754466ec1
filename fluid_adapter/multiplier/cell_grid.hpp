// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A rectilinear grid of cells by numbers alone: cell (i, j, k) is found from a place, never by
// scanning all cells. In two dimensions the third axis has one cell. The cells of an axis are
// equal, or lie between given edges; lengths that a rule counts in cells are then those of the
// cells at hand.
//
// Valid C++17.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace turbidite {

/// What closes the grid at one end of an axis.
enum class Side { wall, open, cyclic };

struct CellGrid {
    int dimension = 2;
    std::array<double, 3> origin{};  ///< lower corner of cell (0, 0, 0) [m]
    std::array<double, 3>
        spacing{};  ///< cell edge along each axis; of a stretched one the mean [m]
    std::array<int, 3> counts{1, 1, 1};
    std::array<std::array<Side, 2>, 3> sides{};  ///< [axis][lower, upper]
    /// Of a stretched axis the ends of its cells, ascending, one more than cells [m]; else empty.
    std::array<std::vector<double>, 3> edges{};

    /// Makes an axis a stretched one.
    void stretch(int axis, const std::vector<double>& ends) {
        edges[axis] = ends;
        counts[axis] = static_cast<int>(ends.size()) - 1;
        origin[axis] = ends.front();
        spacing[axis] = (ends.back() - ends.front()) / counts[axis];
    }

    bool stretched(int axis) const { return !edges[axis].empty(); }
    bool cyclic(int axis) const { return sides[axis][0] == Side::cyclic; }
    double length(int axis) const { return counts[axis] * spacing[axis]; }

    /// Coordinate of the centre of the i-th layer of cells; i may lie outside a cyclic grid.
    double centre(int axis, int i) const {
        if (!stretched(axis)) return origin[axis] + (i + 0.5) * spacing[axis];
        const int turns = turns_of(axis, i), at = i - turns * counts[axis];
        return turns * length(axis) + 0.5 * (edges[axis][at] + edges[axis][at + 1]);
    }

    /// Edge of the cells of a layer along the axis [m]; i may lie outside a cyclic grid.
    double size(int axis, int i) const {
        if (!stretched(axis)) return spacing[axis];
        const int at = i - turns_of(axis, i) * counts[axis];
        return edges[axis][at + 1] - edges[axis][at];
    }

    /// Volume of a cell over that of one with the edges `spacing`; exactly 1 in a uniform grid.
    double relative_volume(int i, int j) const { return relative_size(0, i) * relative_size(1, j); }

    /// Layer of cells that holds a coordinate; may lie outside the grid.
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

    /// The last layer whose centre lies at or below a coordinate; may lie outside the grid.
    int layer_below(int axis, double coordinate) const {
        if (!stretched(axis))
            return static_cast<int>(std::floor((coordinate - origin[axis]) / spacing[axis] - 0.5));
        const int i = layer(axis, coordinate);
        const bool inside = cyclic(axis) || (i >= 0 && i < counts[axis]);
        return inside && coordinate >= centre(axis, i) ? i : i - 1;
    }

    /// Layer brought back into a cyclic grid, or -1 outside a bounded one.
    int wrapped(int axis, int i) const {
        const int n = counts[axis];
        if (i >= 0 && i < n) return i;
        if (!cyclic(axis)) return -1;
        return ((i % n) + n) % n;
    }

    /// The shortest of the images of a difference of places.
    Eigen::Vector3d nearest_image(Eigen::Vector3d difference) const {
        for (int axis = 0; axis < dimension; ++axis)
            if (cyclic(axis))
                difference[axis] -= length(axis) * std::round(difference[axis] / length(axis));
        return difference;
    }

    /// The longest cell edge within `reach` of a place [m].
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

    /// How often a layer's number goes round a cyclic axis.
    int turns_of(int axis, int i) const {
        const int n = counts[axis];
        return i >= 0 ? i / n : -((n - 1 - i) / n);
    }
};

}  // namespace turbidite
