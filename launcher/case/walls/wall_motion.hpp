// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Prescribed motions, defined below domain.motions and named by a side of the box
// (domain.left_motion), by a wall inside it, or by a grain (column motion of both files). Their
// definition is in coupler/protocol/scene/prescribed_motion.hpp.
#pragma once

#include <string>
#include <vector>

#include "coupler/keys/entries.hpp"
#include "coupler/protocol/settings.hpp"
#include "launcher/case/scales.hpp"
#include "launcher/case/walls/inner_walls.hpp"

namespace turbidite {

/// Checks for incomplete or contradictory motions, sides that cannot move, and walls inside the box
/// that name an unknown motion.
CaseProblems check_motions(const Settings& settings, const std::vector<InnerWall>& walls,
                           const CaseEntries& entries);

/// The value of `run.wall_motions`, in run units.
std::string motions_setting(const Settings& settings, const std::vector<InnerWall>& walls,
                            const Scales& scales);

/// The names below domain.motions.
std::vector<std::string> motion_names(const Settings& settings);

/// The value of `run.grain_motions`, in run units.
std::string grain_motions_setting(const Settings& settings, const Packing& grains,
                                  const Scales& scales);

/// One note per motion that no side, wall or grain follows: its name is probably misspelt there.
std::vector<std::string> unfollowed_motions(const Settings& settings,
                                            const std::vector<InnerWall>& walls,
                                            const Packing& grains);

/// The value of `run.inflow_motions`, in run units.
std::string inflows_setting(const Settings& settings, const Scales& scales);

}  // namespace turbidite
