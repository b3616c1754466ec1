// SPDX-License-Identifier: GPL-3.0-or-later
//
// The state of one fluid rank as bytes, for restart: u, p, time, and what the steps pass from
// window to window, bit for bit.
#pragma once

#include <vector>

#include "coupler/participant/adapter.hpp"
#include "fluid_adapter/fluid_window/fluid_step.hpp"
#include "fluid_adapter/foam_app/fields/createFields.hpp"

namespace turbidite {

/// A rank of the fluid: its fields, its steps, and the number i + nx (k + nz j) in the grid of each
/// of its cells.
struct FluidRank {
    FluidFields& fields;
    FluidStep& step;
    std::vector<int> cells;
};

/// `step.put_velocity` and `put_pressure` must have been called. Collective.
SavedState save_fields(const FluidRank& rank);

/// Throws Failure (bad_input) if the state is that of another mesh, decomposition or step.
void restore_fields(const SavedState& state, const FluidRank& rank);

/// This rank's part of the states of all ranks of another decomposition. Throws Failure (bad_input)
/// if they are not complete, or if the steps that wrote them do not work on rows of the box.
SavedState part_of(const std::vector<SavedState>& of_ranks, const FluidRank& rank);

}  // namespace turbidite
