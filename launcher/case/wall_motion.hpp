// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Motions that walls follow, described below domain.motions and named by a side of the box
// (domain.left_motion) or a wall inside it (column motion). What they mean is said in
// granular_adapter/grains/wall_motions.hpp.
#pragma once

#include <string>
#include <vector>

#include "coupler/keys/entries.hpp"
#include "coupler/protocol/settings.hpp"
#include "launcher/case/inner_walls.hpp"
#include "launcher/case/scales.hpp"

namespace turbidite {

/// Motions that say too little or too much, sides that cannot follow one, walls inside the box that
/// name one that is not there. Problems are appended to entries.problems.
void check_motions(const Settings& settings, const std::vector<InnerWall>& walls,
                   CaseEntries& entries);

/// The value of `run.wall_motions`: `WALL KIND NUMBERS...` in run units, separated by `;`.
std::string motions_setting(const Settings& settings, const std::vector<InnerWall>& walls,
                            const Scales& scales);

}  // namespace turbidite
