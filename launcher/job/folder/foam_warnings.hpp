// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What OpenFOAM warned of in the log of the fluid: function objects that find nothing where they
// are to look do not end a run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace turbidite {

struct FoamWarning {
    std::string text;  ///< first line after those of the function and file of OpenFOAM
    int count = 0;     ///< how many times it was given
};

/// In the order of their first lines; empty if there is no log.
std::vector<FoamWarning> foam_warnings(const std::filesystem::path& log);

/// One sentence that names the log and quotes the first few; empty if there are none.
std::string foam_warning_text(const std::vector<FoamWarning>& warnings, const std::string& log);

}  // namespace turbidite
