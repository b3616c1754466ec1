// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Replaces the process by another program: output, signals and exit code are then that program's.
#pragma once

#include <string>
#include <vector>

namespace turbidite {

/// Does not return; throws Failure (exit code 4) if the program cannot be started.
[[noreturn]] void hand_over(std::vector<std::string> line);

}  // namespace turbidite
