// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Windows of the avalanche with one splitting over those with another, contacts included.
#pragma once

#include <vector>

#include "bench/timing/figure.hpp"

namespace turbidite::bench {

std::vector<Figure> splitting_figures();

}  // namespace turbidite::bench
