// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Small scenes shared by several tests: dry discs of density 1, g = 1 unless tilted.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "granular_adapter/nscd/engine/engine.hpp"

namespace turbidite::nscd::scenes {

inline const ShapeTable discs = {{"disc", {}}};

inline Body disc(GrainId id, double x, double y, double radius = 0.5) {
    Body body;
    body.id = id;
    body.radius = radius;
    body.density = 1.0;
    body.mass = std::numbers::pi * radius * radius;
    body.inertia = 0.5 * body.mass * radius * radius;
    body.weight_mass = body.mass;
    body.position = {x, y, 0.0};
    return body;
}

inline Wall wall(std::int32_t key, Vec3 point, Vec3 normal, double friction) {
    Wall result;
    result.key = key;
    result.point = point;
    result.normal = normal;
    result.friction = friction;
    return result;
}

inline Wall floor(double friction) {
    return wall(1, {0, 0, 0}, {0, 1, 0}, friction);
}

/// Gravity in the axes of a plane tilted by alpha: downhill is +x.
inline Vec3 tilted(double alpha) {
    return {std::sin(alpha), -std::cos(alpha), 0.0};
}

inline EngineSettings exact(double friction, double tolerance = 1e-10) {
    EngineSettings settings;
    settings.gravity = {0.0, -1.0, 0.0};
    settings.friction = friction;
    settings.solver_settings.tolerance = tolerance;
    settings.solver_settings.max_iterations = 200000;
    return settings;
}

/// Without friction and weight; cohesion reaches over a length of 0.02 and shears by half.
inline EngineSettings adhesive(const std::string& law, double adhesion, double range) {
    EngineSettings settings = exact(0.0, 1e-13);
    settings.gravity = {};
    Surface surface;
    surface.friction = 0.0;
    surface.adhesion = adhesion;
    settings.surfaces = {surface};
    settings.law.adhesion = law;
    settings.law_settings.adhesion_range = range;
    settings.law_settings.adhesion_length = 0.02;
    settings.law_settings.adhesion_shear = 0.5;
    return settings;
}

/// Discs that fall into a box: columns x rows, with random offsets, without overlap.
inline Engine settling_pack(int columns, int rows, const EngineSettings& settings) {
    const double width = 1.1 * columns;
    Engine engine(settings, discs,
                  {floor(settings.friction), wall(2, {0, 0, 0}, {1, 0, 0}, settings.friction),
                   wall(3, {width, 0, 0}, {-1, 0, 0}, settings.friction)});
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> jitter(-0.02, 0.02);
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            engine.bodies().add(disc(row * columns + column, 0.55 + 1.1 * column + jitter(random),
                                     0.55 + 1.1 * row + jitter(random), 0.48 + jitter(random)));
    return engine;
}

/// Runs for `time`; returns whether every step converged.
inline bool run(Engine& engine, double time, double dt) {
    bool converged = true;
    for (std::int64_t n = std::llround(time / dt); n > 0; --n) {
        converged = engine.step(dt).converged && converged;
        engine.move(dt);
    }
    return converged;
}

}  // namespace turbidite::nscd::scenes
