// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Polygons for tests: some named ones, and random convex ones.
#pragma once

#include <algorithm>
#include <numbers>
#include <random>

#include "coupler/rigid/vec3.hpp"
#include "coupler/shapes/shape.hpp"
#include "scenes.hpp"

namespace turbidite::nscd::scenes {

inline ShapeRecord polygon_record(const std::vector<double>& corners) {
    ShapeRecord record{"polygon", {}};
    for (const Point2& v : normalised_outline(corners).vertices)
        record.vertices.insert(record.vertices.end(), v.begin(), v.end());
    return record;
}

inline ShapeRecord square_record() {
    return polygon_record({0, 0, 1, 0, 1, 1, 0, 1});
}

/// 3 to 9 corners on an ellipse, no side shorter than about a tenth of it.
inline ShapeRecord random_polygon(std::mt19937_64& random) {
    std::uniform_real_distribution<double> share(0.3, 1.0), turn(0.0, 2.0 * std::numbers::pi);
    const int corners = 3 + static_cast<int>(random() % 7);
    std::vector<double> steps;
    double sum = 0.0;
    for (int k = 0; k < corners; ++k) steps.push_back(share(random)), sum += steps.back();
    const double aspect = share(random);
    double angle = turn(random);
    std::vector<double> xy;
    for (const double step : steps) {
        angle += 2.0 * std::numbers::pi * step / sum;
        xy.push_back(std::cos(angle)), xy.push_back(aspect * std::sin(angle));
    }
    return polygon_record(xy);
}

inline Quaternion turned(double angle) {
    return {std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle)};
}

/// Density 1.
inline Body polygon(const ShapeTable& shapes, std::int32_t shape, GrainId id, double x, double y,
                    double radius, double angle = 0.0) {
    const auto made = make_shape(shapes[static_cast<std::size_t>(shape)]);
    Body body;
    body.id = id;
    body.shape = shape;
    body.radius = radius;
    body.density = 1.0;
    body.mass = body.weight_mass = made->volume(radius);
    body.inertia = made->inertia_per_density(radius)(2, 2);
    body.position = {x, y, 0.0};
    body.orientation = turned(angle);
    return body;
}

/// Unit square (side 1) as shape `shape` of the table.
inline Body unit_square(const ShapeTable& shapes, GrainId id, double x, double y,
                        double angle = 0.0) {
    return polygon(shapes, 0, id, x, y, std::numbers::sqrt2 / 2.0, angle);
}

/// Triangles (R = 0.75) at random positions and angles in a box with a floor and two walls, without
/// overlap.
inline Engine falling_triangles(int count, double width, double height,
                                const EngineSettings& settings) {
    const ShapeTable shapes = {{"triangle", {}}};
    const double friction = settings.friction;
    Engine engine(settings, shapes,
                  {floor(friction), wall(2, {0, 0, 0}, {1, 0, 0}, friction),
                   wall(3, {width, 0, 0}, {-1, 0, 0}, friction)});
    std::mt19937_64 random(1);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    const std::vector<Vec3>& placed = engine.bodies().position;
    while (static_cast<int>(placed.size()) < count) {
        const Vec3 x{uniform(0.8, width - 0.8), uniform(0.8, height - 0.8), 0.0};
        const double angle = uniform(0.0, 2.0 * std::numbers::pi);
        if (std::all_of(placed.begin(), placed.end(),
                        [&](const Vec3& other) { return norm(other - x) > 1.51; }))
            engine.bodies().add(
                polygon(shapes, 0, static_cast<GrainId>(placed.size()), x[0], x[1], 0.75, angle));
    }
    return engine;
}

/// Contact points between bodies a and b of a configuration.
inline std::vector<ContactPoint> between(const ShapeTable& shapes, const Bodies& bodies, int a,
                                         int b, double alert) {
    const NarrowPhase narrow(shapes);
    const PlacedShapes placed = narrow.place(bodies);
    const Vec3 &xa = bodies.position[a], &xb = bodies.position[b];
    std::vector<ContactPoint> points;
    narrow.pair({bodies, a, b, {xb[0] - xa[0], xb[1] - xa[1], 0.0}, alert, &placed}, points);
    return points;
}

inline std::vector<ContactPoint> at_wall(const ShapeTable& shapes, const Bodies& bodies,
                                         const Wall& wall, double alert) {
    const NarrowPhase narrow(shapes);
    const PlacedShapes placed = narrow.place(bodies);
    std::vector<ContactPoint> points;
    narrow.wall({bodies, 0, wall, 0, alert, &placed}, points);
    return points;
}

}  // namespace turbidite::nscd::scenes
