// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The constraint of Topin 2011, Eq. 10, at the collocation points,
//
//     slip = B u - T U - R omega        (u - U - omega x r, point by point) [m/s]
//
// and its transpose. Point vectors hold all x components, then all y components. Velocities of
// grains are rows (x, y, spin). Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/multiplier/collocation_points.hpp"

namespace turbidite {

class ConstraintOperator {
 public:
    explicit ConstraintOperator(const CollocationPoints& points) : points_(points) {}

    int rows() const { return 2 * points_.size(); }

    /// out = B u - T U - R omega.
    void apply(const double* ux, const double* uy, const Planar* motions, double* out) const;

    /// fx, fy += B^T values, on cells; halo cells too.
    void spread(const double* values, double* fx, double* fy) const;

    /// out = (T^T, R^T) values: force and moment of every grain, from this rank's points.
    void sum_by_grain(const double* values, Planar* out) const;

 private:
    const CollocationPoints& points_;
};

}  // namespace turbidite
