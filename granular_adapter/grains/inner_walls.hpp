// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Walls inside the box, from the resolved case (`run.walls`, written by launcher/case/inner_walls).
#pragma once

#include <string>
#include <vector>

#include "coupler/protocol/settings.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"

namespace turbidite {

/// Plates in the run's units; none if the setting is missing or empty. `first_key` is the key of
/// the first plate, so that borders keep theirs. Throws std::invalid_argument if the text has
/// another format.
std::vector<nscd::Wall> inner_walls(const Settings& settings, std::int32_t first_key);

}  // namespace turbidite
