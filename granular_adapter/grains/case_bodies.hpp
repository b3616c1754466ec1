// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The grains of a case as bodies of step 4, which moves them with the inertia and the weight of
// shapes/immersed_body, and back.
#pragma once

#include <vector>

#include "coupler/protocol/records.hpp"
#include "coupler/protocol/run_values.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"

namespace turbidite {

/// Throws std::runtime_error naming a grain that is there twice or whose shape is not in the table.
void add_grains(nscd::Bodies& bodies, const RunValues& run, const ShapeTable& shapes,
                const std::vector<GrainState>& grains);

/// Every body with its last window's contact impulses; nothing announced.
std::vector<GrainState> grain_states(const nscd::Bodies& bodies);

/// The kicks' velocities, in the plane. Every grain gets exactly one kick, std::runtime_error
/// naming one that gets none or two; `when` ends the sentence.
void take_velocities(nscd::Bodies& bodies, const std::vector<Kick>& kicks, const std::string& when);

}  // namespace turbidite
