// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The pores of a packing of spheres: what no empty ball of radius D reaches, minus the solid, as
// the triangles of pore_volume.hpp are those whose empty circle has at most this radius. On voxels
// of edge D/8:
//
//     solid    voxels whose centre is in a sphere
//     open     those that are at least D away from the solid: centres of empty balls
//     reached  those within D of an open one
//
// and the pores are the voxels that are neither solid nor reached; D is half a voxel more, the
// distance between a surface and the outermost centres in it. Distances are exact between centres
// of voxels: squares are minimised axis by axis, over the few steps that D has. Cyclic sides are
// taken into account; beyond the others everything is open, so that the gap between a wall and a
// grain is no pore, as in the plane. Where grains are far apart the box around them is cut into
// pieces, of which those without grains cost nothing. Two spheres that touch have 0.12 D^3 of pores
// around the contact.
#pragma once

#include <cstdint>
#include <vector>

#include "coupler/rigid/vec3.hpp"

namespace turbidite {

struct SolidBall {
    Vec3 centre{};        ///< [m]
    double radius = 0.0;  ///< [m]
};

/// [m3], to about one percent of the solid. `period` [m] per axis, 0 where the domain is
/// not cyclic. Pieces of at most 192 voxels a side take 62 MB; how the box is cut changes nothing.
double pore_volume(const std::vector<SolidBall>& balls, double diameter, const Vec3& period,
                   std::int64_t longest_piece = 192);

}  // namespace turbidite
