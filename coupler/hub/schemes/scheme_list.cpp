// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <stdexcept>

#include "coupler/hub/schemes/scheme.hpp"

namespace turbidite {

const std::vector<SchemeEntry>& scheme_list() {
    static const std::vector<SchemeEntry> schemes = {
        split_scheme(),
        joint_scheme(),
        sub_iterated_scheme(),
        dry_scheme(),
    };
    return schemes;
}

std::string scheme_name(const Settings& settings) {
    return settings.flag("fluid.enabled") ? settings.text("coupling.scheme") : "dry";
}

const SchemeEntry& find_scheme(const std::string& name) {
    std::string known;
    for (const SchemeEntry& entry : scheme_list()) {
        if (name == entry.name) return entry;
        known += (known.empty() ? "" : ", ") + std::string(entry.name);
    }
    throw std::invalid_argument("unknown scheme \"" + name + "\"; known: " + known);
}

double SchemeEntry::slip_tolerance(const Settings& settings) const {
    const double alone = settings.real("fluid.multiplier_tolerance");
    if (slip_per_mismatch == 0.0) return alone;
    return std::min(alone, slip_per_mismatch * settings.real("coupling.tolerance"));
}

}  // namespace turbidite
