// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/shapes/disc.hpp"

#include <cmath>
#include <numbers>

namespace turbidite {
namespace {
using std::numbers::pi;
}

double Disc::volume(double radius) const {
    // V = pi R^2
    return pi * radius * radius;
}

Eigen::Matrix3d Disc::inertia_per_density(double radius) const {
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    // I_zz / rho = pi R^4 / 2
    inertia(2, 2) = 0.5 * pi * std::pow(radius, 4);
    return inertia;
}

bool Disc::contains(const Eigen::Vector3d& point, double radius) const {
    return point.head<2>().squaredNorm() <= radius * radius * (1.0 + 2.0 * on_the_edge);
}

std::vector<SurfacePoint> Disc::surface_points(double radius, double spacing) const {
    // Chord 2 R sin(pi / n) >= spacing.
    const double ratio = spacing / (2.0 * radius);
    const int n = ratio < 1.0 ? static_cast<int>(std::floor(pi / std::asin(ratio))) : 1;
    std::vector<SurfacePoint> points;
    points.reserve(n);
    for (int i = 0; i < n; ++i) {
        const double angle = 2.0 * pi * i / n;
        const Eigen::Vector3d normal(std::cos(angle), std::sin(angle), 0.0);
        points.push_back({radius * normal, normal});
    }
    return points;
}

}  // namespace turbidite
