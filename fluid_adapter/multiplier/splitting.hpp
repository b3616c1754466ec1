// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The values of `fluid.splitting` (docs/splittings.md). Valid C++17.
#pragma once

#include <stdexcept>
#include <string>

#include "coupler/protocol/settings.hpp"

namespace turbidite {

enum class Splitting { marchuk_yanenko, explicit_multiplier, implicit_multiplier };

/// Throws std::invalid_argument that lists the known names.
inline Splitting splitting_of(const Settings& settings) {
    const std::string& name = settings.text("fluid.splitting");
    if (name == "marchuk-yanenko") return Splitting::marchuk_yanenko;
    if (name == "explicit-multiplier") return Splitting::explicit_multiplier;
    if (name == "implicit-multiplier") return Splitting::implicit_multiplier;
    throw std::invalid_argument("unknown fluid.splitting \"" + name +
                                "\"; known: marchuk-yanenko, explicit-multiplier, "
                                "implicit-multiplier");
}

/// Whether pressure and viscosity are corrected with rigid grains.
inline bool corrects_with_rigid_grains(const Settings& settings) {
    return splitting_of(settings) != Splitting::marchuk_yanenko;
}

}  // namespace turbidite
