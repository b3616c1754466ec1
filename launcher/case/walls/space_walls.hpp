// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Walls inside the box in space, from a CSV file (`domain.walls_file`):
//
//     id,kind,x,y,z,ax,ay,az[,bx,by,bz][,r1][,r2][,thickness][,vx,vy,vz][,wx,wy,wz][,px,py,pz]
//     [,friction][,material][,motion]
//
//     plate       the rectangle with the corner (x, y, z) and the edges a and b
//     cylinder    around the axis from (x, y, z) on along a and as long as a, radius r1
//     cone        the same, radius r1 at its beginning and r2 at its end
//     ring        about the axis a through (x, y, z) and normal to it, from radius r1 (0: a disc)
//                 to r2
//
// They hold grains on both sides; a thickness makes a wall all that is nearer to its surface than
// half of it. A field that a wall does not need is left empty. Lengths in D, velocities in u_c,
// spins in 1/t_c about a pivot (px, py, pz), which is (x, y, z) or the middle of a plate unless
// given.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "launcher/case/walls/inner_walls.hpp"

namespace turbidite {

/// `materials`: names that the column material may give.
InnerWalls read_space_walls_csv(const std::filesystem::path& file,
                                const std::vector<std::string>& materials);

/// Writes every column; reading it back gives the same walls.
std::string space_walls_csv(const std::vector<InnerWall>& walls);

/// Distance of the surface of a sphere from a wall, negative where they overlap [D].
double surface_gap(const InnerWall& wall, const Vec3& place, double radius);

/// Of the smallest box around a wall; of a cone that around its wider end, all along [D].
Vec3 middle_of(const SpaceForm& form);

/// Length of a box around a wall's faces, parallel to the axes; they are half its thickness from
/// its surface. Its round edges, as far beyond, lie in what begins there: its image, or another
/// wall [D].
Vec3 size_of(const InnerWall& wall);

/// The value of `run.walls` (coupler/protocol/scene/space_walls.hpp), in the run's units.
std::string space_walls_setting(const std::vector<InnerWall>& walls, const Scales& scales,
                                double friction, const std::vector<std::string>& materials);

}  // namespace turbidite
