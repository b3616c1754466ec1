// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The packings of `turbidite bench contact`: a dense column of discs on a floor against a left
// wall, both rough, open to the right (Topin 2011, Fig. 8a); and a column of spheres, likewise,
// that repeats in depth. Lengths in D, g = 1, density 1.
#pragma once

#include "granular_adapter/nscd/engine/engine.hpp"

namespace turbidite::bench {

struct Column {
    double width = 25.0;  ///< [D]; the height is twice this. 25 gives 1397 discs
    /// Radii are in [1 - shrink, 1] D/2: this leaves gaps between neighbours and breaks the perfect
    /// lattice.
    double shrink = 1e-4;
    /// Velocity components are in [-agitation, agitation]: contacts everywhere from the first step.
    double agitation = 0.0;
};

/// The column at rest: a triangular lattice, touching where radii are largest.
nscd::Engine dense_column(const Column& column, const nscd::SolverSettings& settings);

struct SphereColumn {
    /// [D]; the height is twice this, and the depth as large. 26.3 gives 50,000 spheres.
    double width = 26.3;
    double shrink = 1e-3;    ///< radii are in [1 - shrink, 1] D/2
    double agitation = 0.1;  ///< as above
};

/// A face-centred lattice, touching where radii are largest.
nscd::Engine dense_spheres(const SphereColumn& column, const nscd::SolverSettings& settings);

}  // namespace turbidite::bench
