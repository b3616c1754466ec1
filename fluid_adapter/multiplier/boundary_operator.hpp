// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The constraint of Topin 2011, Eq. 10, at the boundary points,
//
//     slip = B u - T U        (u - U - omega x r, point by point) [m/s]
//
// and its transpose. Point vectors hold all x components, then all y components. Velocities of
// grains are rows (x, y, spin). Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/multiplier/collocation_points.hpp"

namespace turbidite {

class BoundaryOperator {
 public:
    explicit BoundaryOperator(const CollocationPoints& points) : points_(points) {}

    int rows() const { return 2 * points_.boundary_points(); }

    /// out = B u - T U.
    void apply(const double* ux, const double* uy, const Planar* motions, double* out) const;

    /// out -= T U.
    void subtract_motion(const Planar* motions, double* out) const;

    /// fx, fy += B^T values, on cells; halo cells too.
    void spread(const double* values, double* fx, double* fy) const;

    /// out = T^T values: force and moment of every grain, from this rank's points.
    void sum_by_grain(const double* values, Planar* out) const;

 private:
    const CollocationPoints& points_;
};

}  // namespace turbidite
