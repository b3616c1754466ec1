// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The geometry of one grain, shared by the fluid and the contact side so that both use the same
// body: volume, inertia, inside test, surface points. Body frame: centre of mass at the origin.
// Sizes scale with the circumscribed radius R of the grain.
//
// Valid C++17.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "coupler/shapes/polygon_outline.hpp"

namespace turbidite {

/// A point of a grain's surface with its outward unit normal, body frame.
struct SurfacePoint {
    Eigen::Vector3d position;
    Eigen::Vector3d normal;
};

/// By which lengths over R may differ and still be R: the centre of a cell at a distance of exactly
/// R is inside in all units, whatever rounding makes of it.
constexpr double on_the_edge = 1e-9;

class Shape {
 public:
    virtual ~Shape() = default;

    virtual int dimension() const = 0;

    /// Area (2-D, per unit length) or volume at radius R [m2 or m3].
    virtual double volume(double radius) const = 0;

    /// Moment of inertia tensor divided by density, body frame; 2-D uses (2,2) only [m4 or m5].
    virtual Eigen::Matrix3d inertia_per_density(double radius) const = 0;

    virtual bool contains(const Eigen::Vector3d& point, double radius) const = 0;

    /// Points nearer to the centre than this are inside; zero gives no information.
    virtual double core_radius(double) const { return 0.0; }

    /// A distance that the point certainly has from the shape; zero gives no information [m].
    virtual double least_distance(const Eigen::Vector3d& point, double radius) const {
        return std::max(0.0, point.norm() - radius);
    }

    /// Largest coordinate of the shape along a unit direction, body frame; or more [m].
    virtual double extent(const Eigen::Vector3d&, double radius) const { return radius; }

    /// Surface points spaced as evenly as the shape allows, never closer than `spacing` [m].
    virtual std::vector<SurfacePoint> surface_points(double radius, double spacing) const = 0;

    /// Corners of a polygon of unit circumradius, counter-clockwise; empty for round shapes.
    virtual std::vector<Point2> outline() const { return {}; }
};

/// All shapes, by the name used in `grains.shape`.
struct ShapeEntry {
    std::string kind;
    std::string description;
    std::shared_ptr<const Shape> (*make)(const ShapeRecord&);
    int dimension = 2;
};
const std::vector<ShapeEntry>& shape_list();

/// Throws std::invalid_argument that lists the known shapes.
std::shared_ptr<const Shape> make_shape(const ShapeRecord& record);

}  // namespace turbidite
