// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd_adapter/free_motion.hpp"

#include <algorithm>
#include <stdexcept>

#include "coupler/protocol/failure.hpp"
#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/grains/by_grain.hpp"

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

std::string grain(const nscd::Bodies& bodies, std::size_t i) {
    return "grain " + std::to_string(bodies.id[i]);
}

bool motion_is_prescribed(const FreeResponse& response) {
    return std::all_of(response.inertia.begin(), response.inertia.end(),
                       [](double entry) { return entry == 0.0; });
}

/// The fluid knows which grains were fixed when the window began, and nothing of a single degree of
/// freedom.
void demand_agreement(const nscd::Bodies& bodies, std::size_t i, bool held,
                      const std::string& when) {
    const bool fixed = bodies.fixed[i] != 0;
    if (held && fixed) return;
    if (!held && !fixed && !bodies.rotation_blocked[i]) return;
    const char* fault = fixed  ? " is fixed by its host "
                        : held ? " is released by its host "
                               : " is kept from rotating by its host ";
    throw std::runtime_error(grain(bodies, i) + fault + when +
                             ", but not in the fluid: fix grains completely and before the run "
                             "(motion = fixed in grains.file), or use coupling.scheme: split");
}

nscd::BodyMobility mobility_of(const nscd::Bodies& bodies, std::size_t i,
                               const FreeResponse& response, const std::string& when) {
    const auto mobility = nscd::inverse(in_plane(response.inertia));
    if (!mobility)
        throw PhysicsRefused("the effective inertia of " + grain(bodies, i) +
                             " is not positive definite " + when);
    return *mobility;
}

}  // namespace

FreeMotion free_motion(const nscd::Bodies& bodies, const std::vector<FreeResponse>& responses,
                       const std::string& when) {
    FreeMotion result;
    const auto ordered = by_grain(bodies.id, responses, "response", when);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const bool held = motion_is_prescribed(*ordered[i]);
        demand_agreement(bodies, i, held, when);
        result.velocities.push_back(in_plane(twist_of(*ordered[i])));
        result.mobilities.push_back(held ? nscd::BodyMobility{}
                                         : mobility_of(bodies, i, *ordered[i], when));
    }
    return result;
}

}  // namespace turbidite
