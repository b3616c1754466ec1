// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Walls with ends in a box with periodic sides: their images are as solid as they are. A body may
// touch several images of one wall at once.
#pragma once

#include <vector>

#include "granular_adapter/nscd/detection/contact_point.hpp"
#include "granular_adapter/nscd/problem/periodic_box.hpp"

namespace turbidite::nscd {

/// The walls, at the same indices, and behind them the images of those with ends that come within
/// `reach` [m] of where the centres of the bodies are.
std::vector<Wall> with_images(const std::vector<Wall>& walls, const Bodies& bodies,
                              const PeriodicBox& box, double reach);

/// Makes the features of points of one body at several images of a wall distinct. At a single image
/// they stay what they are, so that a body that crosses a side keeps its contact memory. `walls`:
/// of the points, from with_images.
void name_images(const std::vector<Wall>& walls, std::vector<ContactPoint>& points);

}  // namespace turbidite::nscd
