// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A uniform grid of cells by numbers alone: cell (i, j, k) is found from a place by index
// arithmetic, never by scanning. In two dimensions the third axis has one cell.
//
// Valid C++17.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

namespace turbidite {

/// What closes the grid at one end of an axis.
enum class Side { wall, open, cyclic };

struct CellGrid {
    int dimension = 2;
    std::array<double, 3> origin{};   ///< lower corner of cell (0, 0, 0) [m]
    std::array<double, 3> spacing{};  ///< cell edge along each axis [m]
    std::array<int, 3> counts{1, 1, 1};
    std::array<std::array<Side, 2>, 3> sides{};  ///< [axis][lower, upper]

    bool cyclic(int axis) const { return sides[axis][0] == Side::cyclic; }
    double length(int axis) const { return counts[axis] * spacing[axis]; }

    /// Coordinate of the centre of the i-th layer of cells; i may lie outside a cyclic grid.
    double centre(int axis, int i) const { return origin[axis] + (i + 0.5) * spacing[axis]; }

    /// Layer of cells that holds a coordinate; may lie outside the grid.
    int layer(int axis, double coordinate) const {
        return static_cast<int>(std::floor((coordinate - origin[axis]) / spacing[axis]));
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

    double largest_spacing() const {
        double h = 0.0;
        for (int axis = 0; axis < dimension; ++axis) h = std::max(h, spacing[axis]);
        return h;
    }
};

}  // namespace turbidite
