// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/method_list.hpp"

#include <stdexcept>

namespace turbidite {

const std::vector<MethodEntry>& method_list() {
    static const std::vector<MethodEntry> methods = {
        {"interior", "cell centres inside the grain; closed form", false, interior_closed_form},
        {"interior+boundary", "cell centres and surface points; conjugate gradients", true,
         uzawa_cg},
    };
    return methods;
}

const MethodEntry& find_method(const std::string& points) {
    std::string known;
    for (const MethodEntry& entry : method_list()) {
        if (entry.points == points) return entry;
        known += (known.empty() ? "" : ", ") + entry.points;
    }
    throw std::invalid_argument("unknown fluid.points \"" + points + "\"; known: " + known);
}

}  // namespace turbidite
