// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/adhesion_settings.hpp"

#include <algorithm>
#include <stdexcept>

namespace turbidite::nscd {

void demand_positive(const std::string& law, const std::string& parameter, double value) {
    if (value > 0.0) return;  // also refuses NaN
    throw std::invalid_argument("contact law \"" + law + "\": " + parameter + " = " +
                                std::to_string(value) + " must be positive");
}

void demand_adhesion(const std::string& law, const LawSettings& settings,
                     const SurfaceTable& surfaces) {
    demand_positive(law, "range", settings.adhesion_range);
    demand_positive(law, "reference diameter", settings.reference_diameter);
    double strongest = 0.0;
    for (const Surface& pair : surfaces.all_pairs()) strongest = std::max(strongest, pair.adhesion);
    demand_positive(law, "adhesion of the surfaces", strongest);
}

}  // namespace turbidite::nscd
