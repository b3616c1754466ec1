// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/contact/dense_packing.hpp"

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

nscd::Body sphere(GrainId id, const Vec3& place, double radius) {
    nscd::Body body;
    body.id = id;
    body.radius = radius;
    body.density = 1.0;
    body.mass = body.weight_mass = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
    body.inertia = 0.4 * body.mass * radius * radius;
    body.position = place;
    return body;
}

/// Sites of a face-centred cubic lattice of unit distance in [0, size), cubic axes along x, y, z.
template <class Visit>
void each_site(const Vec3& size, const Visit& visit) {
    const double half = std::sqrt(0.5);  // of the edge of the cubic cell
    for (int j = 0; j * half < size[1]; ++j)
        for (int k = 0; (k + 1) * half <= size[2]; ++k)
            for (int i = (j + k) % 2; i * half < size[0]; i += 2)
                visit(Vec3{i * half, j * half, k * half});
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

nscd::Engine dense_spheres(const SphereColumn& column,
                           const nscd::SolverSettings& solver_settings) {
    nscd::EngineSettings settings;
    settings.dimension = 3;
    settings.gravity = {0.0, -1.0, 0.0};
    settings.friction = friction;
    settings.solver_settings = solver_settings;
    // An even number of layers in depth, so that the lattice repeats.
    const double layers = 2.0 * std::round(column.width / std::sqrt(2.0));
    const double depth = layers * std::sqrt(0.5);
    settings.box.length = {0.0, 0.0, depth};
    nscd::Engine engine(settings, {{"sphere", {}}},
                        {wall(1, {0.0, 1.0, 0.0}), wall(2, {1.0, 0.0, 0.0})});
    std::mt19937_64 random(1);
    GrainId id = 0;
    each_site({column.width - 0.5, 2.0 * column.width - 0.5, depth + 1e-9}, [&](const Vec3& site) {
        const double radius = 0.5 * (1.0 - column.shrink * next(random));
        nscd::Body body = sphere(++id, site + Vec3{0.5, 0.5, 0.0}, radius);
        for (double& component : body.twist.velocity)
            component = column.agitation * (2.0 * next(random) - 1.0);
        engine.bodies().add(body);
    });
    return engine;
}

}  // namespace turbidite::bench
