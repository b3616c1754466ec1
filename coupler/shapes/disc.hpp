// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupler/shapes/shape.hpp"

namespace turbidite {

/// Disc of radius R in the plane: V = pi R^2, I_zz / rho = pi R^4 / 2 (both per unit length).
class Disc final : public Shape {
 public:
    int dimension() const override { return 2; }
    double volume(double radius) const override;
    Eigen::Matrix3d inertia_per_density(double radius) const override;
    bool contains(const Eigen::Vector3d& point, double radius) const override;
    double core_radius(double radius) const override { return radius; }
    std::vector<SurfacePoint> surface_points(double radius, double spacing) const override;
};

}  // namespace turbidite
