// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite bench fluid, in space: the fluid step against stock icoFoam, the plane, larger meshes
// and two ranks; its memory; and the share of the coupling in the shipped settling spheres.
#pragma once

#include "bench/timing/figure.hpp"

namespace turbidite::bench {

std::vector<Figure> space_figures();

}  // namespace turbidite::bench
