// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The initial flow of benchmarks without grains: one large vortex and smaller ones 2.5 D wide, the
// size of the wakes among grains. It is divergence-free, and zero on all walls if the sides are
// multiples of 2.5 D. bench/icofoam/system/setExprFieldsDict defines the same flow for OpenFOAM,
// both for icoFoam and for our fluid.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

namespace turbidite::bench {

/// u, v [u_c] at x, y [D] in a box of lx by ly [D].
inline std::pair<double, double> start_flow(double lx, double ly, double x, double y) {
    using std::numbers::pi;
    constexpr double small = pi / 2.5;
    const auto bump = [](double a) { return std::sin(a) * std::sin(a); };
    const double u = 0.25 * bump(pi / lx * x) * std::sin(2.0 * pi / ly * y) +
                     0.5 * bump(small * x) * std::sin(2.0 * small * y);
    const double v = 0.25 * ly / lx * std::sin(2.0 * pi / lx * x) * bump(pi / ly * y) +
                     0.5 * std::sin(2.0 * small * x) * bump(small * y);
    return {u, -v};
}

}  // namespace turbidite::bench
