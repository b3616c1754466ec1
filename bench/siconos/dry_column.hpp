// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The dry column of the paper (Topin 2011, Fig. 8a) with the contact engine alone: a lattice of
// discs D = 1 in the corner of a left wall and a floor, free to the right, mu = 0.3, no
// restitution, g = 1, density 1; t_c = 1. Supplies contact problems to tests and benchmarks.
#pragma once

#include "granular_adapter/nscd/engine/engine.hpp"

namespace turbidite::bench {

struct DryColumn {
    double compacity = 0.9069;
    double width = 25.0;      ///< [D]
    double height = 50.0;     ///< [D]
    double tolerance = 1e-3;  ///< of the solver that advances the column
    double step = 0.01;       ///< [t_c]
};

/// The column at t = 0.
nscd::Engine dry_column(const DryColumn& column);

/// Advances the column by `time`.
void play(nscd::Engine& engine, double time, double step);

}  // namespace turbidite::bench
