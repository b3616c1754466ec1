// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Numbers of cells along the axes that are solved by Fourier transforms: x, and z in space. A
// transform of n values costs n times about the sum of the prime factors of n.
#pragma once

#include <string>
#include <vector>

#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// The largest prime factor of n >= 1; 1 for 1.
int largest_prime_factor(int n);

/// The smallest number from n on without a prime factor above 7.
int good_transform_length(int n);

/// A sentence for every transformed axis of the fluid's box whose number of cells makes solves
/// slow, with the next length that does not.
std::vector<std::string> slow_transforms(const Settings& settings);

}  // namespace turbidite
