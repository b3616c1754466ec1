// SPDX-License-Identifier: LGPL-2.1-or-later
//
// When Gauss-Seidel solvers evaluate the residual, and the settings that every solver refuses.
#pragma once

#include <cstdint>
#include <stdexcept>

#include "granular_adapter/nscd/solvers/solver.hpp"

namespace turbidite::nscd {

/// Early sweeps are checked often, since a warm start may converge at once.
inline bool check_due(std::int64_t sweep_number, const SolverSettings& settings) {
    const bool power_of_two = (sweep_number & (sweep_number - 1)) == 0;
    return sweep_number % settings.check_interval == 0 || sweep_number >= settings.max_iterations ||
           (sweep_number < settings.check_interval && power_of_two);
}

inline void check_settings(const SolverSettings& settings) {
    if (!(settings.tolerance > 0.0) || settings.max_iterations < 1 || settings.check_interval < 1 ||
        settings.threads < 1)
        throw std::invalid_argument(
            "contact solver: tolerance, iterations, check interval and threads must be positive");
}

}  // namespace turbidite::nscd
