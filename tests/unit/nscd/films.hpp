// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What tests of films of liquid between spheres and between discs share.
#pragma once

#include "scenes.hpp"

namespace turbidite::nscd::scenes {

constexpr double roughness = 1e-3, cutoff = 0.1;

inline EngineSettings with_film(EngineSettings settings, double viscosity) {
    settings.law.film = "lubrication";
    settings.law_settings.viscosity = viscosity;
    settings.law_settings.film_cutoff = cutoff;
    settings.law_settings.film_roughness = roughness;
    return settings;
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
