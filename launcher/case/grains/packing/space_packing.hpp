// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "launcher/case/grains/packing/packing.hpp"

namespace turbidite {

/// Volume fraction above which spheres are not placed at random but have to be poured.
inline constexpr double largest_random_fraction = 0.45;

/// grains.count spheres in a region of space: one by one at random places with a gap of 0.1 D or
/// less; where they do not fit, on random sites of a lattice (fcc, for the largest of them), which
/// are shaken. Refused above largest_random_fraction.
PackingResult random_space_packing(const PackingRequest& request);

}  // namespace turbidite
