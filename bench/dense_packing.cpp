// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/dense_packing.hpp"

#include <cmath>
#include <numbers>
#include <random>

namespace turbidite::bench {
namespace {

constexpr double friction = 0.3;
const double row_height = std::sqrt(0.75);

nscd::Wall wall(std::int32_t key, const Vec3& normal) {
    nscd::Wall result;
    result.key = key;
    result.normal = normal;
    result.friction = friction;
    return result;
}

/// Uniform in [0, 1), the same with every standard library.
double next(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

nscd::Body disc(GrainId id, double x, double y, double radius) {
    nscd::Body body;
    body.id = id;
    body.radius = radius;
    body.density = 1.0;
    body.mass = body.weight_mass = std::numbers::pi * radius * radius;
    body.inertia = 0.5 * body.mass * radius * radius;
    body.position = {x, y, 0.0};
    return body;
}

}  // namespace

nscd::Engine dense_column(const Column& column, const nscd::SolverSettings& solver_settings) {
    nscd::EngineSettings settings;
    settings.gravity = {0.0, -1.0, 0.0};
    settings.friction = friction;
    settings.solver_settings = solver_settings;
    nscd::Engine engine(settings, {{"disc", {}}},
                        {wall(1, {0.0, 1.0, 0.0}), wall(2, {1.0, 0.0, 0.0})});
    std::mt19937_64 random(1);
    GrainId id = 0;
    for (int row = 0; row * row_height + 1.0 <= 2.0 * column.width; ++row)
        for (double x = row % 2 == 0 ? 0.5 : 1.0; x + 0.5 <= column.width; x += 1.0) {
            const double radius = 0.5 * (1.0 - column.shrink * next(random));
            nscd::Body body = disc(++id, x, 0.5 + row * row_height, radius);
            for (int axis = 0; axis < 2; ++axis)
                body.twist.velocity[axis] = column.agitation * (2.0 * next(random) - 1.0);
            engine.bodies().add(body);
        }
    return engine;
}

}  // namespace turbidite::bench
