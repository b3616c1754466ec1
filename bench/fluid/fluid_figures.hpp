// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite bench fluid: the fluid step against stock icoFoam, against a code written by hand for
// one purpose, on a larger mesh, and on two ranks; and its memory.
#pragma once

#include "bench/timing/figure.hpp"

namespace turbidite::bench {

std::vector<Figure> fluid_figures();

}  // namespace turbidite::bench
