// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/siconos/dry_column.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "launcher/case/grains/packing/lattice.hpp"

namespace turbidite::bench {
namespace {

nscd::Body disc(const PlacedGrain& grain) {
    nscd::Body body;
    body.id = grain.id;
    body.radius = grain.radius;
    body.density = 1.0;
    body.mass = body.weight_mass = std::numbers::pi * grain.radius * grain.radius;
    body.inertia = 0.5 * body.mass * grain.radius * grain.radius;
    body.position = {grain.x, grain.y, 0.0};
    return body;
}

nscd::Wall wall(std::int32_t key, const Vec3& normal, double friction) {
    nscd::Wall plane;
    plane.key = key;
    plane.normal = normal;
    plane.friction = friction;
    return plane;
}

}  // namespace

nscd::Engine dry_column(const DryColumn& column) {
    nscd::EngineSettings settings;
    settings.gravity = {0.0, -1.0, 0.0};
    settings.friction = 0.3;
    settings.solver_settings.tolerance = column.tolerance;
    settings.solver_settings.max_iterations = 5000;
    nscd::Engine engine(settings, {{"disc", {}}},
                        {wall(1, {0.0, 1.0, 0.0}, 0.3), wall(2, {1.0, 0.0, 0.0}, 0.3)});
    const PackingResult packing =
        lattice_packing({.box = {column.width, column.height}, .compacity = column.compacity});
    if (!packing.refusal.empty()) throw std::invalid_argument(packing.refusal);
    for (const PlacedGrain& grain : packing.grains) engine.bodies().add(disc(grain));
    return engine;
}

void play(nscd::Engine& engine, double time, double step) {
    for (long n = std::lround(time / step); n > 0; --n) engine.step(step), engine.move(step);
}

}  // namespace turbidite::bench
