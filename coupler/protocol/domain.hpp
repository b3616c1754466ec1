// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the coupler reads of the domain.
#pragma once

#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// Per axis the length after which the domain repeats [m]; 0 where it is not cyclic.
inline Vec3 domain_periods(const Settings& settings) {
    const auto period = [&](const char* side, const char* size) {
        return settings.text(side) == "cyclic" ? settings.real(size) : 0.0;
    };
    return {period("domain.left", "run.size_x"), period("domain.bottom", "run.size_y"), 0.0};
}

}  // namespace turbidite
