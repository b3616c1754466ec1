// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/shapes/sphere.hpp"

#include <cmath>
#include <numbers>

namespace turbidite {
namespace {

using std::numbers::pi;

/// The largest number of points on a circle of this radius with chords 2 r sin(pi / n) >= spacing;
/// at least one.
int points_on_circle(double radius, double spacing) {
    const double ratio = spacing / (2.0 * radius);
    return ratio < 1.0 ? static_cast<int>(std::floor(pi / std::asin(ratio))) : 1;
}

}  // namespace

double Sphere::volume(double radius) const {
    return 4.0 / 3.0 * pi * radius * radius * radius;
}

Eigen::Matrix3d Sphere::inertia_per_density(double radius) const {
    // I / rho = (2/5) V R^2
    return 0.4 * volume(radius) * radius * radius * Eigen::Matrix3d::Identity();
}

bool Sphere::contains(const Eigen::Vector3d& point, double radius) const {
    return point.squaredNorm() <= radius * radius;
}

std::vector<SurfacePoint> Sphere::surface_points(double radius, double spacing) const {
    // Circles of latitude about e_z, whose distances along a meridian are chords of at least the
    // spacing; at a pole the circle is a point.
    // Half of the points of a whole meridian circle: from pole to pole.
    const int bands = points_on_circle(radius, spacing) / 2;
    std::vector<SurfacePoint> points;
    for (int k = 0; k <= bands; ++k) {
        const double polar = bands > 0 ? pi * k / bands : 0.0;
        const bool pole = k == 0 || k == bands;
        const double sine = pole ? 0.0 : std::sin(polar);
        const int n = pole ? 1 : points_on_circle(radius * sine, spacing);
        for (int i = 0; i < n; ++i) {
            const double angle = 2.0 * pi * i / n;
            const Eigen::Vector3d normal(sine * std::cos(angle), sine * std::sin(angle),
                                         std::cos(polar));
            points.push_back({radius * normal, normal});
        }
    }
    return points;
}

}  // namespace turbidite
