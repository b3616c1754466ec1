// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What figures of the fluid read from samples, and their notes.
#pragma once

#include <string>
#include <vector>

#include "bench/timing/site.hpp"

namespace turbidite::bench {

double processor(const Sample& sample);  ///< [s]
double wall(const Sample& sample);       ///< [s]
double resident(const Sample& sample);   ///< [bytes]

/// "icoFoam 812 ms"
std::string milliseconds(const std::string& who, const std::vector<Sample>& samples);

/// "320x960: 42 ns per cell"
std::string per_cell(const std::string& box, double cells, const std::vector<Sample>& samples);

/// The value and its spread over `by`.
void divide(Measured& measured, double by);

/// Distribution of a window's time: medians over all repeats.
std::string profile(const std::vector<Sample>& samples);

}  // namespace turbidite::bench
