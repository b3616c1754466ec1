// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Corners and normals of all polygons in world axes, rotated and scaled once per detection instead
// of once per pair. The values of a polygon are contiguous. Corners are relative to the centre of
// mass, so that no precision is lost far from the origin and periodic images need no copy.
#pragma once

#include <cstddef>
#include <vector>

#include "coupler/shapes/polygon_outline.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"

namespace turbidite::nscd {

/// A convex polygon, counter-clockwise. Side k goes from corner k to the next and has the outward
/// unit normal k; support[k] = normal[k] . corner[k] [m]. A plate has two corners and one side.
struct PolygonView {
    const double* x = nullptr;  ///< corners, relative to the centre [m]
    const double* y = nullptr;
    const double* nx = nullptr;
    const double* ny = nullptr;
    const double* support = nullptr;
    int corners = 0;
    int sides = 0;
    double radius = 0.0;     ///< circumscribed radius [m]
    double in_radius = 0.0;  ///< smallest support: no point of the outline is closer to the centre

    int after(int corner) const { return corner + 1 < corners ? corner + 1 : 0; }
    int before(int corner) const { return corner > 0 ? corner - 1 : corners - 1; }
};

/// Outlines of the shapes of a run, by shape index; empty for round shapes.
class PolygonShapes {
 public:
    explicit PolygonShapes(const ShapeTable& shapes);

    /// An outline of circumradius 1.
    struct UnitPolygon {
        std::vector<double> numbers;  ///< x, y, nx, ny, support: five arrays, one after the other
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

/// The polygons of all bodies of a configuration. Keeps references to shapes and radii.
class PlacedPolygons {
 public:
    PlacedPolygons(const PolygonShapes& shapes, const Bodies& bodies);

    /// The polygon of a body; it must have corners.
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
    std::vector<std::size_t> first_;  ///< where the values of each body begin in `numbers_`
    std::vector<double> numbers_;
};

}  // namespace turbidite::nscd
