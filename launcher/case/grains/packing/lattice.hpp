// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The lattice of the paper: rows of spacing a, alternate rows shifted by a/2, neighbours in
// adjacent rows touching, so with D = 1 the row height is sqrt(1 - a^2/4) and the compacity
//
//     phi = (pi/4) / (a sqrt(1 - a^2/4)),   a from 1 (pi / 2 sqrt 3, densest) to sqrt 2 (pi/4).
//
// Fill of a W x H region: row k at y = 1/2 + k height while y + 1/2 <= H; x from 1/2 (odd rows
// 1/2 + a/2) while x + 1/2 <= W. 25 x 50 gives 1,397 grains (densest) to 1,190 (loosest).
//
// A row is a horizontal line of grains. Rows touch, so with a jitter j the filled lattice is first
// stretched: two grains that each move by up to j along x and y approach each other by up to
// 2 sqrt(2) j, for which a stretch by 1 + 2 sqrt(2) j makes room. It reduces the compacity by
// 4 sqrt(2) j and the number of grains not at all; it is limited to 1 % of the compacity and to the
// room in the box.
#pragma once

#include "launcher/case/grains/packing/packing.hpp"

namespace turbidite {

/// Smallest and largest compacity of the lattice: pi/4 and pi/(2 sqrt 3).
double loosest_compacity();
double densest_compacity();

/// Spacing a that gives the compacity [D]; the argument lies between the two bounds.
double lattice_spacing(double compacity);

/// Largest relative loss of compacity by a jitter.
inline constexpr double compacity_for_jitter = 0.01;

/// Values within 1e-3 outside the bounds are clamped with a note, others refused. A jitter
/// stretches the lattice (see above); a note states the resulting compacity.
PackingResult lattice_packing(const PackingRequest& request);

/// Displaces each grain by up to `jitter` along x and y, in space also z; a displacement that would
/// make grains overlap or leave `limits` is halved until it fits, and finally dropped. Returns how
/// many grains moved.
std::int64_t shake(Packing& grains, const PackingRequest& request, const PackingRegion& limits);

/// The same within the box, if there is a jitter; adds a note if grains had no room.
void apply_jitter(PackingResult& result, const PackingRequest& request);

}  // namespace turbidite
