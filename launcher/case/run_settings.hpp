// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What follows from the keys of a case and is decided once for all programs of the job: run.* in
// the settings, and the grains in run units.
#pragma once

#include <vector>

#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"
#include "launcher/case/grains/packing/packing.hpp"
#include "launcher/case/scales.hpp"
#include "launcher/case/walls/inner_walls.hpp"

namespace turbidite {

/// Replaces coupling.scheme: auto, before anything depends on it.
void choose_scheme(Settings& settings);

/// Sets every run.* value but run.hash.
void set_run_settings(Settings& settings, const Packing& grains,
                      const std::vector<InnerWall>& walls, const Scales& scales);

std::vector<GrainState> grain_states(const Packing& grains, const Settings& settings,
                                     const Scales& scales);

}  // namespace turbidite
