// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/mobilities.hpp"

#include "granular_adapter/nscd/problem/plane/mobility.hpp"

namespace turbidite::nscd {

Mobilities mobilities_of(const Bodies& bodies) {
    std::vector<PlanarTensor> result;
    result.reserve(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i)
        result.push_back({bodies.inverse_mass(i), bodies.inverse_inertia(i).zz});
    return result;
}

}  // namespace turbidite::nscd
