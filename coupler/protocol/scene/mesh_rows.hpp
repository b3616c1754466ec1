// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// The rows of cells of the fluid's mesh, from the bottom up. They are squares of edge h = D over
/// fluid.cells_per_diameter up to fluid.stretch_from, rounded up to a whole row. Above, each is r
/// times as high as the one below, up to fluid.stretch_largest h:
///
///     h_k = min(h r^k, L),  k = 1 .. n
///
/// n is the smallest number for which fluid.stretch_ratio reaches the top, and r the ratio up to
/// that one with which n rows end there exactly. Valid C++17.
#pragma once

#include <optional>
#include <vector>

#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// Cells along each axis of the fluid's box: room for the widest stencil, three layers, beside a
/// wall.
inline constexpr int fewest_cells = 4;

/// Lengths in D.
struct MeshRows {
    int equal = 0;                  ///< rows of height `height`, from the bottom up
    double height = 0.0;            ///< h
    double ratio = 1.0;             ///< r
    std::vector<double> stretched;  ///< heights of the others

    int count() const { return equal + static_cast<int>(stretched.size()); }

    /// Up to which the rows are equal.
    double equal_height() const { return equal * height; }

    /// Height of the highest row.
    double largest() const { return stretched.empty() ? height : stretched.back(); }

    /// Of the row at a height y; of the highest row above all of them.
    double height_at(double y) const;
};

/// The rows of a mesh whose height is `top` D. All of them are equal unless fluid.stretch_ratio is
/// above 1; nothing if there is no room to grow above fluid.stretch_from, or for more than a
/// million rows.
std::optional<MeshRows> mesh_rows(const Settings& settings, double top);

/// The least room above fluid.stretch_from in which rows can grow by fluid.stretch_ratio [D]: in
/// any larger one no row has to be lower than h. Infinite for a ratio too near to 1.
double least_stretched_room(const Settings& settings);

/// Whether the settings ask for rows that are not equal.
bool rows_are_stretched(const Settings& settings);

}  // namespace turbidite
