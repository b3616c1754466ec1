// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What tests of films of liquid between spheres and between discs share.
#pragma once

#include <gtest/gtest.h>

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

/// A film between grains and floor changes neither what slides nor the coefficient of what slides:
/// in the step after the first every contact with the floor has the lower one, and is at its limit.
inline void expect_sliding_friction_below_films(int dimension) {
    const double slope = 0.8, alpha = std::atan(slope);
    Engine engine = scenes::sliding_layers(slope, dimension, 0.001);
    engine.step(0.01);
    engine.move(0.01);
    int sliding = 0, films = 0;
    for (int n = 1; n < 100; ++n) {
        ASSERT_TRUE(engine.step(0.01).converged);
        for (std::size_t k = 0; k < engine.points().size(); ++k) {
            const ContactVector r = engine.carried()[k];
            if (engine.points()[k].wall < 0 || !(r.n > 0.0)) continue;
            ++sliding, films += r.n < engine.solution()[k].n;
            EXPECT_EQ(engine.problem().contacts[k].friction, 0.3);
            EXPECT_NEAR(tangential(r), 0.3 * r.n, 1e-12 * r.n);
        }
        engine.move(0.01);
    }
    EXPECT_GT(sliding, 700);
    EXPECT_GT(films, 100) << "films carry a part";
    double mean = 0.0;
    for (const Twist& twist : engine.bodies().twist) mean += twist.velocity[0] / 32.0;
    EXPECT_NEAR(mean, 0.5 + std::sin(alpha) - 0.3 * std::cos(alpha), 0.002);
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
