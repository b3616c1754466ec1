// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd_adapter/free_motion.hpp"

#include <stdexcept>

#include "coupler/protocol/failure.hpp"
#include "granular_adapter/grains/by_grain.hpp"
#include "granular_adapter/nscd/problem/vec3.hpp"

namespace turbidite {
namespace {

nscd::PlanarTensor in_plane(const std::array<double, 21>& inertia) {
    constexpr std::size_t x = 0, y = 1, spin = 5;  // of the six components
    nscd::PlanarTensor tensor;
    tensor.xx = inertia[upper_entry(x, x)];
    tensor.xy = inertia[upper_entry(x, y)];
    tensor.xs = inertia[upper_entry(x, spin)];
    tensor.yy = inertia[upper_entry(y, y)];
    tensor.ys = inertia[upper_entry(y, spin)];
    tensor.ss = inertia[upper_entry(spin, spin)];
    return tensor;
}

nscd::Twist in_plane(const FreeResponse& response) {
    return {{response.velocity[0], response.velocity[1], 0.0},
            {0.0, 0.0, response.angular_velocity[2]}};
}

std::string grain(const nscd::Bodies& bodies, std::size_t i) {
    return "grain " + std::to_string(bodies.id[i]);
}

}  // namespace

FreeMotion free_motion(const nscd::Bodies& bodies, const std::vector<FreeResponse>& responses,
                       const std::string& when) {
    FreeMotion result;
    const auto ordered = by_grain(bodies.id, responses, "response", when);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.fixed[i] || bodies.rotation_blocked[i])
            throw std::runtime_error(grain(bodies, i) + " is fixed by its host " + when +
                                     ", but the fluid moves every grain for which it sends a "
                                     "response; use coupling.scheme: split");
        const nscd::Twist twist = in_plane(*ordered[i]);
        const auto mobility = nscd::inverse(in_plane(ordered[i]->inertia));
        if (!mobility)
            throw PhysicsRefused("the effective inertia of " + grain(bodies, i) +
                                 " is not positive definite " + when);
        result.velocities.push_back(twist);
        result.mobilities.push_back(*mobility);
    }
    return result;
}

}  // namespace turbidite
