// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupler/shapes/shape.hpp"

namespace turbidite {

/// Sphere of radius R: V = (4/3) pi R^3, I / rho = (2/5) V R^2 about every axis.
class Sphere final : public Shape {
 public:
    int dimension() const override { return 3; }
    double volume(double radius) const override;
    Eigen::Matrix3d inertia_per_density(double radius) const override;
    bool contains(const Eigen::Vector3d& point, double radius) const override;
    double core_radius(double radius) const override { return radius; }
    std::vector<SurfacePoint> surface_points(double radius, double spacing) const override;
};

}  // namespace turbidite
