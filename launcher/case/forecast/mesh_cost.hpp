// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How many cells the fluid of a case has and how much memory it takes, over all its ranks, and how
// much memory there is.
#pragma once

#include <vector>

#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// OpenFOAM counts faces with 32 bits, and a mesh of one layer has four per cell.
inline constexpr double most_cells = 5e8;

/// The programs that play the fluid, as fluid.program names them.
enum class FluidProgram { openfoam, box };
const char* program_name(FluidProgram program);

/// That of a case whose `auto` has been decided (launcher/case/keys/fluid_program.hpp).
FluidProgram fluid_program(const Settings& settings);

/// Whether OpenFOAM computes a fluid, with a case in the run folder.
bool has_openfoam(const Settings& settings);

/// Rows of the mesh (coupler/protocol/scene/mesh_rows.hpp); of equal ones where they cannot be
/// stretched.
double fluid_rows(const Settings& settings);

/// Cells of the mesh: columns times rows.
double fluid_cells(const Settings& settings);

/// Resident memory of this fluid program [GB = 1e9 bytes]: bytes per cell (figures bytes_per_cell
/// and bytes_per_cell_space of `turbidite bench fluid`), the vectors of time and splitting, and
/// what the program takes by itself.
double fluid_memory(const Settings& settings, FluidProgram program);

/// The same of the case's own program.
double fluid_memory(const Settings& settings);

/// The keys that cells and memory follow from.
const std::vector<const char*>& keys_of_memory();

/// limits.memory, or the memory of this machine [GB].
double memory_limit(const Settings& settings);

}  // namespace turbidite
