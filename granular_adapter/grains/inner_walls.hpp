// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Walls inside the box (coupler/protocol/scene/plates.hpp, in space space_walls.hpp) as walls of
// the contact problem.
#pragma once

#include <vector>

#include "coupler/protocol/settings.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"

namespace turbidite {

/// In the run's units; none if the setting is missing or empty. Throws std::invalid_argument if the
/// text has another format than that of the run's dimension.
std::vector<nscd::Wall> inner_walls(const Settings& settings);

}  // namespace turbidite
