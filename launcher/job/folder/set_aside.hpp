// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A run folder that another run is to take the place of, kept under another name.
#pragma once

#include <cstdint>
#include <filesystem>

namespace turbidite {

/// The last window of which something is left, a row of the history or a checkpoint; 0 if there is
/// none.
std::int64_t windows_kept(const std::filesystem::path& folder);

/// Whether there are windows that it would cost time to play again.
bool has_windows(const std::filesystem::path& folder);

/// Renames it to the first free one of FOLDER-old-1, FOLDER-old-2, …, which it returns. Throws
/// Failure (bad input) if a run uses it, (participant failed) if it cannot be renamed.
std::filesystem::path set_aside(const std::filesystem::path& folder);

}  // namespace turbidite
