// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A given number of equal discs (D = 1) without overlap, placed at random in the region.
//
// Random sequential addition with a smallest gap of 0.1 D, taken smaller step by step (never below
// 0) when the grains do not fit; it saturates at a solid fraction of about 0.547. Denser requests
// take random sites of the loosest lattice that has enough of them and shake the grains by
// hard-disc Monte Carlo moves.
#pragma once

#include "coupler/case/packing.hpp"

namespace turbidite {

PackingResult random_packing(const PackingRequest& request);

}  // namespace turbidite
