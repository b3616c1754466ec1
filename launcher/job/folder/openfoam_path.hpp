// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

namespace turbidite {

/// Whether OpenFOAM finds files in a folder of this name: it drops blanks and quotes, and takes a
/// backslash for a slash.
inline bool openfoam_finds(const std::filesystem::path& folder) {
    return folder.string().find_first_of(" \t\n\"'\\") == std::string::npos;
}

}  // namespace turbidite
