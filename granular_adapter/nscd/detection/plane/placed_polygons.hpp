// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Corners and normals of all polygons in world axes, turned and scaled once per detection, not once
// per pair. A polygon's numbers lie side by side; corners are arms from the centre of mass, so that
// nothing is lost far from the origin and periodic images need no copy.
#pragma once

#include <cstddef>
#include <vector>

#include "coupler/shapes/polygon_outline.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"

namespace turbidite::nscd {

/// A convex polygon, counter-clockwise. Side k leads from corner k to the next and has the outward
/// unit normal k; support[k] = normal[k] . corner[k] [m]. A plate is two corners and one side.
struct PolygonView {
    const double* x = nullptr;  ///< corners, from the centre [m]
    const double* y = nullptr;
    const double* nx = nullptr;
    const double* ny = nullptr;
    const double* support = nullptr;
    int corners = 0;
    int sides = 0;
    double radius = 0.0;     ///< circumscribed [m]
    double in_radius = 0.0;  ///< smallest support: no point of the outline is nearer to the centre

    int after(int corner) const { return corner + 1 < corners ? corner + 1 : 0; }
    int before(int corner) const { return corner > 0 ? corner - 1 : corners - 1; }
};

/// Outlines of one run's shapes, by shape index; empty for round ones.
class PolygonShapes {
 public:
    explicit PolygonShapes(const ShapeTable& shapes);

    struct UnitPolygon {
        std::vector<double> numbers;  ///< x, y, nx, ny, support: a row of each
        int corners = 0;
        double in_radius = 0.0;
    };
    const UnitPolygon& operator[](std::int32_t shape) const {
        return polygons_[static_cast<std::size_t>(shape)];
    }
    bool any() const { return any_; }

 private:
    std::vector<UnitPolygon> polygons_;
    bool any_ = false;
};

/// All bodies of a configuration. Keeps references to shapes and radii.
class PlacedPolygons {
 public:
    PlacedPolygons(const PolygonShapes& shapes, const Bodies& bodies);

    /// Of a body with corners.
    PolygonView operator[](std::int32_t body) const {
        const auto i = static_cast<std::size_t>(body);
        const PolygonShapes::UnitPolygon& unit = shapes_[bodies_.shape[i]];
        const int n = unit.corners;
        const double* row = numbers_.data() + first_[i];
        const double radius = bodies_.radius[i];
        return {row,         row + n,     row + 2 * n,
                row + 3 * n, row + 4 * n, n,
                n,           radius,      radius * unit.in_radius};
    }

 private:
    void place(std::size_t body);

    const PolygonShapes& shapes_;
    const Bodies& bodies_;
    std::vector<std::size_t> first_;  ///< of each body in `numbers_`
    std::vector<double> numbers_;
};

}  // namespace turbidite::nscd
