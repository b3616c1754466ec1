// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Prescribed motions of walls, defined below domain.motions and named by a side of the box
// (domain.left_motion) or a wall inside it (column motion). Their definition is in
// coupler/protocol/prescribed_motion.hpp.
#pragma once

#include <string>
#include <vector>

#include "coupler/keys/entries.hpp"
#include "coupler/protocol/settings.hpp"
#include "launcher/case/inner_walls.hpp"
#include "launcher/case/scales.hpp"

namespace turbidite {

/// Checks for incomplete or contradictory motions, sides that cannot move, and walls inside the box
/// that name an unknown motion. Problems are appended to entries.problems.
void check_motions(const Settings& settings, const std::vector<InnerWall>& walls,
                   CaseEntries& entries);

/// The value of `run.wall_motions`, in run units.
std::string motions_setting(const Settings& settings, const std::vector<InnerWall>& walls,
                            const Scales& scales);

/// The value of `run.inflow_motions`, in run units.
std::string inflows_setting(const Settings& settings, const Scales& scales);

}  // namespace turbidite
