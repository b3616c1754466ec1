// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A case of the user's own, which begins as a copy of a shipped one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace turbidite {

struct OwnCase {
    std::filesystem::path file;
    std::vector<std::filesystem::path> beside;  ///< files that the case names, copied with it
};

/// Copies a case with its comments to `file`, and the files that it names to the same places beside
/// it, but for equal ones that are there. Throws Failure (bad input) if one of them exists already
/// or cannot be written; then there is no case.
OwnCase write_own_case(const std::filesystem::path& shipped, const std::filesystem::path& file);

}  // namespace turbidite
