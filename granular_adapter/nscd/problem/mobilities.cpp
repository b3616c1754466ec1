// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/mobilities.hpp"

#include "granular_adapter/nscd/problem/plane/mobility.hpp"
#include "granular_adapter/nscd/problem/space/mobility.hpp"

namespace turbidite::nscd {
namespace {

template <class Mobility, class Make>
std::vector<Mobility> by_body(const Bodies& bodies, const Make& make) {
    std::vector<Mobility> result;
    result.reserve(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i)
        result.push_back(make(bodies.inverse_mass(i), bodies.inverse_inertia(i)));
    return result;
}

}  // namespace

Mobilities mobilities_of(const Bodies& bodies, int dimension) {
    if (dimension == 2)
        return by_body<PlanarTensor>(bodies, [](double linear, const Symmetric3& angular) {
            return PlanarTensor(linear, angular.zz);
        });
    return by_body<SpaceMobility>(bodies, [](double linear, const Symmetric3& angular) {
        // The moments of a sphere about all axes are equal.
        return SpaceMobility{linear, angular.xx};
    });
}

}  // namespace turbidite::nscd
