// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What tests of films of liquid between spheres and between discs share.
#pragma once

#include "spheres.hpp"

namespace turbidite::nscd::scenes {

constexpr double roughness = 1e-3, cutoff = 0.1;

inline EngineSettings with_film(EngineSettings settings, double viscosity) {
    settings.law.film = "lubrication";
    settings.law_settings.viscosity = viscosity;
    settings.law_settings.film_cutoff = cutoff;
    settings.law_settings.film_roughness = roughness;
    return settings;
}

/// Four close layers of grains that cannot rotate slide down a slope as a block, under the law of
/// static (0.5) and sliding (0.3) friction; cyclic downhill, at a speed of 0.5 at first.
inline Engine sliding_layers(double slope, int dimension, double viscosity) {
    EngineSettings settings = exact(0.3, 1e-8);
    settings.dimension = dimension;
    settings.gravity = tilted(std::atan(slope));
    settings.law.friction = "static-dynamic";
    Surface surface;
    surface.friction = 0.3;
    surface.static_friction = 0.5;
    settings.surfaces = {surface};
    const int columns = 8, rows = 4;
    const double apart = 1.001;
    settings.box.length = {columns * apart, 0.0, 0.0};
    if (viscosity > 0.0) settings = with_film(settings, viscosity);
    Wall plane = floor(0.0);
    plane.material = 0;
    Engine engine(settings, dimension == 3 ? spheres : discs, {plane});
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const GrainId id = row * columns + column;
            // Triangles of the sides 1.001, 1, 1.
            const double height = std::sqrt(1.0 - 0.25 * apart * apart);
            const double x = (column + 0.5 * (row % 2)) * apart, y = 0.5 + row * height;
            engine.bodies().add(dimension == 3 ? sphere(id, {x, y, 0.0}) : disc(id, x, y));
            engine.bodies().rotation_blocked.back() = 1;
            engine.bodies().twist.back().velocity = {0.5, 0.0, 0.0};
        }
    return engine;
}

/// Steps of 0.01; the report of the last.
inline StepReport settled(Engine& engine, int steps) {
    StepReport report;
    for (int i = 0; i < steps; ++i) {
        report = engine.step(0.01);
        engine.move(0.01);
    }
    return report;
}

}  // namespace turbidite::nscd::scenes
