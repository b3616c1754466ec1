// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Small scenes in space shared by several tests: dry spheres of density 1, g = 1 unless tilted.
#pragma once

#include "scenes.hpp"

namespace turbidite::nscd::scenes {

inline const ShapeTable spheres = {{"sphere", {}}};

inline Body sphere(GrainId id, const Vec3& position, double radius = 0.5) {
    Body body;
    body.id = id;
    body.radius = radius;
    body.density = 1.0;
    body.mass = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
    body.inertia = 0.4 * body.mass * radius * radius;
    body.weight_mass = body.mass;
    body.position = position;
    return body;
}

inline EngineSettings exact_in_space(double friction, double tolerance = 1e-10) {
    EngineSettings settings = exact(friction, tolerance);
    settings.dimension = 3;
    return settings;
}

/// Floor and four sides of a box with the floor [0, width] x [0, width].
inline std::vector<Wall> open_box(double width, double friction) {
    return {floor(friction), wall(2, {0, 0, 0}, {1, 0, 0}, friction),
            wall(3, {width, 0, 0}, {-1, 0, 0}, friction), wall(4, {0, 0, 0}, {0, 0, 1}, friction),
            wall(5, {0, 0, width}, {0, 0, -1}, friction)};
}

/// Spheres that fall into an open box: columns x rows x columns, with random offsets and sizes,
/// without overlap. `order`: how they are stored.
inline Engine settling_spheres(int columns, int rows, const EngineSettings& settings,
                               const std::vector<std::size_t>& order = {}) {
    Engine engine(settings, spheres, open_box(1.1 * columns, settings.friction));
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> jitter(-0.02, 0.02);
    std::vector<Body> bodies;
    for (int y = 0; y < rows; ++y)
        for (int z = 0; z < columns; ++z)
            for (int x = 0; x < columns; ++x) {
                const Vec3 place{0.55 + 1.1 * x + jitter(random), 0.55 + 1.1 * y + jitter(random),
                                 0.55 + 1.1 * z + jitter(random)};
                bodies.push_back(
                    sphere(static_cast<GrainId>(bodies.size()) + 1, place, 0.48 + jitter(random)));
            }
    for (std::size_t i = 0; i < bodies.size(); ++i)
        engine.bodies().add(bodies[order.empty() ? i : order[i]]);
    return engine;
}

inline double kinetic_energy(const Bodies& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i)
        sum += 0.5 * b.mass[i] * dot(b.twist[i].velocity, b.twist[i].velocity) +
               0.5 * dot(b.twist[i].spin, b.inertia[i] * b.twist[i].spin);
    return sum;
}

}  // namespace turbidite::nscd::scenes
