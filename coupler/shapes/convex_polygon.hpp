// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupler/shapes/shape.hpp"

namespace turbidite {

/// Convex polygon in the plane with vertices v_i, counter-clockwise about the centre of mass, all
/// of unit circumradius; a grain of radius R has vertices R v_i. Exact (Green's theorem), with
/// w_i = v_i x v_i+1:
///
///     V = R^2 sum w_i / 2,   I_zz / rho = R^4 sum w_i (|v_i|^2 + v_i . v_i+1 + |v_i+1|^2) / 12
class ConvexPolygon final : public Shape {
 public:
    /// x, y of every vertex. Throws std::invalid_argument if they do not form a convex polygon
    /// (polygon_outline.hpp), are not counter-clockwise, or do not have unit circumradius about the
    /// centre of mass to 1e-9.
    explicit ConvexPolygon(const std::vector<double>& vertices);

    int dimension() const override { return 2; }
    double volume(double radius) const override;
    Eigen::Matrix3d inertia_per_density(double radius) const override;
    bool contains(const Eigen::Vector3d& point, double radius) const override;

    /// From the farthest of the lines along its sides.
    double least_distance(const Eigen::Vector3d& point, double radius) const override;

    double extent(const Eigen::Vector3d& direction, double radius) const override;

    /// Corners first, then equally spaced points on the sides; a point nearer than `spacing` to a
    /// previous one is left out, so that the distance is kept at sharp corners as well. The normal
    /// at a corner bisects the angle between those of the sides.
    std::vector<SurfacePoint> surface_points(double radius, double spacing) const override;

    std::vector<Point2> outline() const override { return vertices_; }

 private:
    /// Distance of a point from the line along a side, positive outside [m].
    double beyond(std::size_t side, const Eigen::Vector3d& point, double radius) const;

    std::vector<Point2> vertices_;
    std::vector<Point2> normals_;  ///< of the side from a vertex to the next, outward
    double area_ = 0.0;
    double second_moment_ = 0.0;
};

}  // namespace turbidite
