// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite bench coupling: what the coupling costs, with scripted programs in the place of codes
// and in a real run.
#pragma once

#include "bench/timing/figure.hpp"
#include "bench/timing/run_history.hpp"

namespace turbidite::bench {

std::vector<Figure> coupling_figures();

/// Share of the wall time of the windows after `from` [t_c] in which neither the fluid nor the
/// grains program computes, by their own clocks. For schemes in which they take turns.
double coupling_share(const RunHistory& history, double from);

}  // namespace turbidite::bench
