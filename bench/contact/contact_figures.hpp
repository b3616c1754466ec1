// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite bench contact: the speed of the contact solver on dense packings, alone and against
// others. Each figure is measured in a file of its own; this is the list.
#pragma once

#include "bench/timing/figure.hpp"

namespace turbidite::bench {

std::vector<Figure> contact_figures();

}  // namespace turbidite::bench
