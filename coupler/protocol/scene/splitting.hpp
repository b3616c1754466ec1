// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// The values of `fluid.splitting` (docs/splittings.md). Valid C++17.
#pragma once

#include <array>
#include <stdexcept>
#include <string>

#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// One value of `fluid.splitting` and what it does.
struct Splitting {
    const char* name;
    const char* help;
    bool rigid_grains;  ///< pressure and viscosity are corrected with rigid grains
    bool iterated;      ///< that correction goes on until it is within a tolerance
};

/// All of them.
inline constexpr std::array<Splitting, 3> splittings = {{
    {"marchuk-yanenko", "as in Topin et al. 2011", false, false},
    {"explicit-multiplier", "carries pressure and contacts, corrects them once with rigid grains",
     true, false},
    {"implicit-multiplier", "the same, iterated to fluid.splitting_tolerance", true, true},
}};

/// Throws std::invalid_argument that lists the known names.
inline const Splitting& splitting_of(const Settings& settings) {
    const std::string& name = settings.text("fluid.splitting");
    std::string known;
    for (const Splitting& splitting : splittings) {
        if (name == splitting.name) return splitting;
        known += (known.empty() ? "" : ", ") + std::string(splitting.name);
    }
    throw std::invalid_argument("unknown fluid.splitting \"" + name + "\"; known: " + known);
}

}  // namespace turbidite
