// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite bench contact: the contact solver's speed on dense packings, alone and beside others.
// Each figure is measured in a file of its own; here is the list.
#pragma once

#include "bench/figure.hpp"

namespace turbidite::bench {

std::vector<Figure> contact_figures();

}  // namespace turbidite::bench
