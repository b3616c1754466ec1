// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The fluid's part of a run folder: a valid OpenFOAM case, written from the resolved case. A
// two-dimensional case is one layer of cells between `empty` patches. p is kinematic (over rho_f)
// and reduced (without its hydrostatic part). Valid C++17.
#pragma once

#include <filesystem>

#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// Writes system/, constant/ and 0/ below `directory`. Throws Failure for settings that no OpenFOAM
/// case can express, and for files that cannot be written.
void write_fluid_case(const Settings& settings, const std::filesystem::path& directory);

/// The part of it that says which rank has which cells.
void write_decomposition(const Settings& settings, const std::filesystem::path& directory);

/// Sets the end of an existing case; whatever a user has changed in it stays.
void extend_fluid_case(const Settings& settings, const std::filesystem::path& directory);

/// Runs blockMesh on the case, with its output in `log`. Returns 0; throws Failure with blockMesh's
/// own message if it is missing or fails.
int build_fluid_mesh(const std::filesystem::path& directory, const std::filesystem::path& log);

/// Runs decomposePar on a case with a mesh: one processor folder per rank of fluid.ranks. Errors as
/// above.
int decompose_fluid_case(const std::filesystem::path& directory, const std::filesystem::path& log);

}  // namespace turbidite
