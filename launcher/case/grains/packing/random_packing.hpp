// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A given number of grains of one form without overlap, placed at random in the region. Polygons
// lie at random angles. With a size ratio q the radii are uniform between 2 R/(1 + q) and
// 2 R q/(1 + q), R the radius of the form, so that their mean is R; large grains are placed first.
//
// Random sequential addition with a minimum gap of 0.1 D, reduced step by step to 0 if the grains
// do not fit; it saturates at a solid fraction of about 0.547. For denser packings, grains are put
// on random sites of the loosest lattice that has enough of them and moved by hard-disc Monte
// Carlo. This applies to equal discs of diameter D; others keep a gap of at least 0.005 D between
// their true surfaces, and are refused if they do not fit.
#pragma once

#include <vector>

#include "launcher/case/grains/packing/packing.hpp"
#include "launcher/case/grains/packing/random_numbers.hpp"

namespace turbidite {

constexpr int attempts_per_grain = 500;
constexpr double shaking_distance = 0.2;  // [D]

/// Radii lie between 2 R/(1 + q) and 2 R q/(1 + q): their mean is R, largest over smallest q.
double smallest_radius(double mean, double size_ratio);

/// Radii of grains.count grains by grains.radius and grains.size_ratio, from the largest to the
/// smallest [D].
std::vector<double> draw_radii(const PackingRequest& request, RandomNumbers& random);

/// Of spheres [D3].
double solid_volume(const std::vector<double>& radii);

/// Share of the region that grains.count spheres fill even if each is as small as grains.size_ratio
/// allows: refuses counts for which drawing the radii alone would fill the memory.
double least_solid_fraction(const PackingRequest& request);

PackingResult random_packing(const PackingRequest& request);

}  // namespace turbidite
