// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What grains ask of the fluid, of the program that moves them and of the box: shapes, prescribed
// motions, cells across a grain, equal rows of cells, light grains, room between cyclic sides.
#pragma once

#include "coupler/keys/entries.hpp"
#include "coupler/protocol/settings.hpp"
#include "launcher/case/grains/start_grains.hpp"

namespace turbidite {

/// Of each kind of fault the first grain is named.
CaseProblems check_abilities(const StartGrains& start, const Settings& settings,
                             const GrainForms& forms);

/// Cyclic sides are as far apart as the two largest grains are wide together: nearer, two grains
/// could touch on both sides.
CaseProblems check_periods(const Packing& grains, const Settings& settings,
                           const CaseEntries& entries);

/// The volume that the fluid sees of a sphere of this radius [D] over its own, where that is more
/// (fluid.surface_shift); 1 in the plane. Without the fluid's responses grains must be denser.
double displaced_share(const Settings& settings, double radius);

}  // namespace turbidite
