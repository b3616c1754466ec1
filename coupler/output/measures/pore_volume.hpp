// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The pores of a packing: Delaunay triangles of the grains' centres with a circumradius of at most
// D, or 2 sqrt(V/pi) with the mean area V of their grains if that is larger, minus the solid
// inside. Wider triangles are open space: a free surface, the gap between falling grains.
//
//     pores = sum over triangles ( area - sum over vertices V_i angle_i / (2 pi) )
//
// For equal discs without overlap the share by angle is exact: a sector of radius D/2 stays inside
// its triangle, whose heights are bc/(2R) >= D/2. For other shapes and sizes the grain is divided
// among the triangles around it by angle, which is exact in sum wherever they surround it. Cyclic
// sides are taken into account.
#pragma once

#include <vector>

#include "coupler/protocol/records.hpp"

namespace turbidite {

struct SolidGrain {
    double x = 0.0;  ///< [m]
    double y = 0.0;
    double area = 0.0;  ///< V, per unit length [m2]
};

/// [m2]. `period` [m] per axis, 0 where the domain is not cyclic.
double pore_volume(const std::vector<SolidGrain>& grains, double diameter, const Vec3& period);

}  // namespace turbidite
