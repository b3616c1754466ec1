// SPDX-License-Identifier: GPL-2.0-or-later
//
// What one component of u is on the sides of a box where it is prescribed: on a wall that slides,
// or where fluid enters. Zero on all others, so that beyond a side lies
//
//     u_{-1} = f u_0 + 2 u_b          f: +-1, row_reader.hpp;  u_b: 0 unless f = -1
//
// and the mean of both is the value at the face. Valid C++17.
#pragma once

#include <array>
#include <vector>

namespace turbidite {

/// Left and right by row of this rank, k + nz j; bottom and top by cell of a layer, i + nx k; in
/// space also before the first and after the last row of a layer, i + nx j [m/s].
using SideValues = std::array<std::vector<double>, 6>;

/// Of all components of u.
using VelocityOnSides = std::array<SideValues, 3>;

}  // namespace turbidite
