// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How long a run takes, before it starts: rough, machines and packings differ by a factor of two.
#pragma once

#include <string>

#include "launcher/case/case_file.hpp"

namespace turbidite {

/// Wall time of all windows [s]: of the fluid (mesh_cost.hpp), or in dry runs of the grains.
double predicted_seconds(const ResolvedCase& resolved);

/// "40 s", "12 min", "3 h", "2 days"
std::string rough_time(double seconds);

}  // namespace turbidite
