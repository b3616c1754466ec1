// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Poured packings (grains.generator: poured, in space): a dry run that comes before the run itself.
// grains.count spheres fall, from random places at a fraction of 0.25, into a box on the ground
// area of grains.region, with walls where this is smaller than the box, and come to rest. The run
// then starts from them, as with --from. Without friction while they fall packings are dense, about
// 0.64; with 0.5 loose, about 0.57 (grains.pour_friction).
#pragma once

#include <string>
#include <vector>

#include "launcher/case/case_file.hpp"
#include "launcher/case/grains/packing/packing.hpp"

namespace turbidite {

/// Largest solid fraction of a poured packing. Without friction 0.64; grains of several sizes fill
/// more.
inline constexpr double densest_poured = 0.66;

/// Whether the grains of a case are to be poured; not where they come from a file or another run.
bool is_poured(const Settings& settings);

/// What the case of the pouring run changes in a poured case, as arguments of --set.
std::vector<std::string> pouring_changes(const ResolvedCase& resolved);

/// Gives stand-ins (below) the radii of the grains that will be poured; more grains may follow
/// them.
void take_poured_radii(Packing& stand_ins, const Settings& settings);

/// Grains in the place of those that are not yet poured, for checks and forecasts: the lowest sites
/// of an fcc lattice in the region.
PackingResult poured_stand_in(const PackingRequest& request);

}  // namespace turbidite
