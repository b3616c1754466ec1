// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How thick a wall inside the box has to be so that no fluid passes through it. Across a row of
// cells the way through a wall of thickness t is t/|n_y|, so it is tight with
//
//     t >= 2 max(h, h_j |n_y|)
//
// h: edge of a square cell; h_j: height of the highest row that it reaches.
//
// Valid C++17.
#pragma once

#include "coupler/protocol/scene/mesh_rows.hpp"
#include "coupler/shapes/wall_surface.hpp"

namespace turbidite {

constexpr double least_cells_of_wall = 2.0;

/// Of a plate in the plane, from end to end.
WallSurface surface_of_plate(const Vec3& from, const Vec3& to);

/// For a wall of a thickness where it is, in the unit of the rows.
double least_thickness(const WallSurface& surface, double thickness, const MeshRows& rows);

/// Whether that is more than the thickness, beyond what a box of whole cells changes their edges.
bool is_too_thin(double thickness, double least);

}  // namespace turbidite
