// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The saved state of a fluid in plain arrays: a header and, one after the other, the arrays
// themselves, each over the layers of the rank that wrote it,
//
//     u by component, p, and what the step remembers (BoxFluidStep::visit_memory),
//
// written from where they are and read into them, on as many ranks as there are. Valid C++17.
#pragma once

#include <vector>

#include "coupler/protocol/files/stored_file.hpp"
#include "fluid_adapter/box_app/box_field.hpp"
#include "fluid_adapter/fluid_window/box_fluid_step.hpp"

namespace turbidite {

void write_state(BoxField& field, BoxFluidStep& step, PieceWriter& file);

/// `of_ranks`: the files of all ranks that wrote the state. Throws Failure (bad input) for a state
/// of another mesh or other steps, and for one that is incomplete.
void read_state(std::vector<PieceReader>& of_ranks, BoxField& field, BoxFluidStep& step);

}  // namespace turbidite
