// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One line of `turbidite doctor`: what was looked at, how it is, and the command that mends it.
#pragma once

#include <string>
#include <vector>

namespace turbidite {

enum class Health { ok, missing, wrong, not_tried };

struct Diagnosis {
    Health health = Health::ok;
    std::string name;
    std::string text;    ///< version, place, or what is wrong
    std::string remedy;  ///< a command to type; empty if all is well
};

using Diagnoses = std::vector<Diagnosis>;

/// Builds the programs of a run, and installs the packages that the build needs.
constexpr auto build_command = "./turbidite --version";
/// Brings back what an installation has lost.
constexpr auto reinstall_command = "apt-get install --reinstall turbidite";

/// The command that installs a Debian package.
inline std::string install_command(const std::string& package) {
    return "apt-get install --no-install-recommends " + package;
}

}  // namespace turbidite
