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

/// Cyclic sides must be so far apart that no two grains can touch, or attract each other, on both
/// sides (coupler/shapes/shortest_period.hpp).
CaseProblems check_periods(const Packing& grains, const Settings& settings,
                           const CaseEntries& entries);

/// The density [rho_f] above which a grain of this radius [D] has the effective mass and inertia
/// that it needs without the fluid's responses: 1, in space more where the fluid sees a sphere
/// larger than it is (fluid.surface_shift).
double least_density(const Settings& settings, double radius);

/// Of the smallest grain by grains.radius and grains.size_ratio; those of a file may be smaller.
double least_density(const Settings& settings);

/// R_h/R = h + s/(cells per R) of a grain of this radius [D]; s in space only.
double seen_radius(const Settings& settings, double radius);

/// V(R_h)/V of a grain of this radius [D]: what the fluid sees of it.
double displaced_volume(const Settings& settings, double radius);

}  // namespace turbidite
