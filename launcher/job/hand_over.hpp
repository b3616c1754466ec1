// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The process becomes another program: its output, signals and exit code are then that program's.
#pragma once

#include <string>
#include <vector>

namespace turbidite {

/// Returns only by throwing Failure (exit code 4), when the program cannot be started.
[[noreturn]] void hand_over(std::vector<std::string> line);

}  // namespace turbidite
