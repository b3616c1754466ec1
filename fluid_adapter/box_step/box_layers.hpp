// SPDX-License-Identifier: GPL-2.0-or-later
//
// The cells of a rank: layers of the cells of one y, each of nz rows of nx cells along x, a single
// row in the plane. Cell i of row k of layer j has the number i + nx (k + nz j). Valid C++17.
#pragma once

#include <cstddef>
#include <vector>

#include "fluid_adapter/box_step/row_heights.hpp"

namespace turbidite {

struct BoxLayers {
    BoxLayers(const SeparableOperator& grid, const BoxRows& rows)
        : nx(grid.x.cells),
          ny(rows.count()),
          nz(grid.z.cells),
          hx(grid.x.spacing),
          hz(grid.z.spacing),
          periodic_x(grid.x.periodic()),
          periodic_z(grid.z.periodic()),
          open_below(rows.open_below()),
          open_above(rows.open_above()),
          heights(grid.y, rows) {}

    int nx, ny, nz;
    double hx, hz;  ///< [m]; hz is 1 in the plane, where areas and volumes are per unit length
    bool periodic_x, periodic_z, open_below, open_above;
    RowHeights heights;

    bool in_space() const { return nz > 1; }
    int components() const { return in_space() ? 3 : 2; }
    std::size_t layer() const { return static_cast<std::size_t>(nx) * nz; }
    std::size_t cells() const { return layer() * ny; }

    /// Number of the first cell of row k of layer j.
    std::size_t row(int j, int k) const { return j * layer() + static_cast<std::size_t>(k) * nx; }

    // Values on faces normal to an axis: one row more along y than there are layers, one more along
    // z than a layer has rows, and one value more in rows along x. Face row (j, k) is below, or
    // behind, row k of layer j.

    std::size_t faces(int axis) const { return face_row(axis, ny, 0) + (axis == 1 ? layer() : 0); }
    std::size_t face_row(int axis, int j, int k) const {
        const std::size_t rows = axis == 2 ? nz + 1 : nz;
        return (j * rows + k) * faces_of_row(axis);
    }
    std::size_t faces_of_row(int axis) const { return axis == 0 ? nx + 1 : nx; }

    /// Whether the faces below layer j, or behind the rows k, are on a side of the box.
    bool side_below(int j) const { return (j == 0 && !open_below) || (j == ny && !open_above); }
    bool side_behind(int k) const { return !periodic_z && (k == 0 || k == nz); }
};

/// Values on the faces normal to every axis of a velocity's components, laid out as above.
using FaceValues = std::vector<std::vector<double>>;

}  // namespace turbidite
