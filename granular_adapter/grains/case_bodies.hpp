// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Converts the grains of a case to bodies of step 4 and back. Step 4 moves them with the inertia
// and weight of shapes/immersed_body.
#pragma once

#include <optional>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "coupler/protocol/run_values.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"

namespace turbidite {

/// Throws std::runtime_error naming a grain that occurs twice or whose shape is not in the table.
void add_grains(nscd::Bodies& bodies, const RunValues& run, const ShapeTable& shapes,
                const std::vector<GrainState>& grains);

/// The first grain of free motion whose effective mass or inertia is not positive; `grains` as for
/// add_grains.
std::optional<GrainId> first_light_grain(const RunValues& run, const ShapeTable& shapes,
                                         const std::vector<GrainState>& grains);

/// Throws std::runtime_error naming the grain and the scheme that can move it.
[[noreturn]] void refuse_light_grain(GrainId id);

/// Every body with the contact impulses of its last window; J_h is zero.
std::vector<GrainState> grain_states(const nscd::Bodies& bodies);

/// Sets the velocities from the kicks, with dimension 2 those in the plane only. Throws
/// std::runtime_error naming a grain with no kick or two; `when` ends the sentence.
void take_velocities(nscd::Bodies& bodies, const std::vector<Kick>& kicks, const std::string& when,
                     int dimension);

}  // namespace turbidite
