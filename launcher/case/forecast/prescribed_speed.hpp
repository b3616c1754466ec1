// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How fast sides, walls, entering fluid and grains move that follow a prescribed motion.
#pragma once

#include "launcher/case/case_file.hpp"

namespace turbidite {

/// The largest mean speed of a window on any surface with a prescribed motion, in the run's units;
/// of long runs in windows spread over the run.
double fastest_prescribed(const ResolvedCase& resolved);

}  // namespace turbidite
