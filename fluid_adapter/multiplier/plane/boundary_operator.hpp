// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The constraint of Topin 2011, Eq. 10, at the boundary points,
//
//     slip = B u - T U        (u - U - omega x r, point by point) [m/s]
//
// and its transpose. Point vectors hold x and y of each point side by side. Velocities of grains
// are (x, y, spin); those of cells are (x, y), by slot (collocation_points.hpp). Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/multiplier/plane/collocation_points.hpp"
#include "fluid_adapter/multiplier/plane/planar.hpp"

namespace turbidite {

/// Both components of a vector field in a cell, side by side: a point reads both.
struct PlaneVector {
    double x = 0.0, y = 0.0;
};

class BoundaryOperator {
 public:
    explicit BoundaryOperator(const CollocationPoints& points) : points_(points) {}

    int rows() const { return 2 * points_.boundary_points(); }

    /// out = B u - T U.
    void apply(const PlaneVector* u, const Planar* motions, double* out) const;

    /// out -= T U.
    void subtract_motion(const Planar* motions, double* out) const;

    /// Spreading: f += B^T values, halo cells included.
    void spread(const double* values, PlaneVector* f) const;

    /// out = T^T values: force and moment on every grain from this rank's points.
    void sum_by_grain(const double* values, Planar* out) const;

 private:
    const CollocationPoints& points_;
};

}  // namespace turbidite
