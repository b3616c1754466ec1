// SPDX-License-Identifier: LGPL-2.1-or-later
#include <stdexcept>

#include "coupler/shapes/convex_polygon.hpp"
#include "coupler/shapes/disc.hpp"
#include "coupler/shapes/shape.hpp"
#include "coupler/shapes/sphere.hpp"

namespace turbidite {
namespace {

using ShapePointer = std::shared_ptr<const Shape>;

ShapePointer make_disc(const ShapeRecord&) {
    return std::make_shared<Disc>();
}

ShapePointer make_sphere(const ShapeRecord&) {
    return std::make_shared<Sphere>();
}

ShapePointer make_triangle(const ShapeRecord& record) {
    const auto& vertices = record.vertices;
    return std::make_shared<ConvexPolygon>(vertices.empty() ? equilateral_triangle() : vertices);
}

ShapePointer make_polygon(const ShapeRecord& record) {
    return std::make_shared<ConvexPolygon>(record.vertices);
}

}  // namespace

const std::vector<ShapeEntry>& shape_list() {
    static const std::vector<ShapeEntry> shapes = {
        {"disc", "circular grain", make_disc},
        {"triangle", "equilateral triangle, at angle 0 with one side at the bottom", make_triangle},
        {"polygon", "convex polygon with the corners of grains.vertices", make_polygon},
        {"sphere", "ball in space", make_sphere, 3},
    };
    return shapes;
}

std::shared_ptr<const Shape> make_shape(const ShapeRecord& record) {
    std::string known;
    for (const ShapeEntry& entry : shape_list()) {
        if (entry.kind == record.kind) return entry.make(record);
        known += (known.empty() ? "" : ", ") + entry.kind;
    }
    throw std::invalid_argument("unknown shape \"" + record.kind + "\"; known: " + known);
}

}  // namespace turbidite
