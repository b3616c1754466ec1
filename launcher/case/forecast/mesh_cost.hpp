// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How many cells the fluid of a case has and how much memory it takes, over all its ranks, and how
// much memory there is.
#pragma once

#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// OpenFOAM counts faces with 32 bits, and a mesh of one layer has four per cell.
inline constexpr double most_cells = 5e8;

/// Rows of the mesh (coupler/protocol/mesh_rows.hpp); of equal ones where they cannot be stretched.
double fluid_rows(const Settings& settings);

/// Cells of the mesh: columns times rows.
double fluid_cells(const Settings& settings);

/// Resident memory of the fluid program [GB = 1e9 bytes]: 750 bytes per cell (figure bytes_per_cell
/// of `turbidite bench fluid`), the vectors of time and splitting, and what OpenFOAM takes by
/// itself.
double fluid_memory(const Settings& settings);

/// limits.memory, or the memory of this machine [GB].
double memory_limit(const Settings& settings);

}  // namespace turbidite
