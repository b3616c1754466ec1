// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A given number of grains of one form without overlap, placed at random in the region. Polygons
// lie at random angles. With a size ratio q the radii are uniform between 2 R/(1 + q) and
// 2 R q/(1 + q), R the form's own, so that their mean stays R; large grains are placed first.
//
// Random sequential addition with a smallest gap of 0.1 D, taken smaller step by step (never below
// 0) when the grains do not fit; it saturates at a solid fraction of about 0.547. Denser requests
// take random sites of the loosest lattice that has enough of them and shake the grains by
// hard-disc Monte Carlo moves. That is for equal discs of diameter D; others keep a gap of 0.005 D
// or more, of their true surfaces, and are refused when they do not fit.
#pragma once

#include "launcher/case/packing.hpp"

namespace turbidite {

PackingResult random_packing(const PackingRequest& request);

}  // namespace turbidite
