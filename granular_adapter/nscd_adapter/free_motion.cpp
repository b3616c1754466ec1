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
    // The effective inertia is a symmetric 6 x 6 matrix over (x, y, z, turn about x, y, z), of
    // which the upper triangle is sent.
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

/// The block of three components from `first` on.
Symmetric3 block(const std::array<double, 21>& inertia, std::size_t first) {
    const auto entry = [&](std::size_t i, std::size_t j) {
        return inertia[upper_entry(first + i, first + j)];
    };
    Symmetric3 result;
    result.xx = entry(0, 0), result.yy = entry(1, 1), result.zz = entry(2, 2);
    result.xy = entry(0, 1), result.xz = entry(0, 2), result.yz = entry(1, 2);
    return result;
}

double inverse_mean(const Symmetric3& inertia) {
    // 1/(tr A/3)
    return 3.0 / (inertia.xx + inertia.yy + inertia.zz);
}

std::optional<nscd::PlanarTensor> mobility(const FreeResponse& response, nscd::PlanarTensor) {
    return nscd::inverse(in_plane(response.inertia));
}

std::optional<nscd::SpaceMobility> mobility(const FreeResponse& response, nscd::SpaceMobility) {
    const Symmetric3 linear = block(response.inertia, 0), angular = block(response.inertia, 3);
    if (!positive_definite(linear) || !positive_definite(angular)) return std::nullopt;
    return nscd::SpaceMobility{inverse_mean(linear), inverse_mean(angular)};
}

std::string grain(const nscd::Bodies& bodies, std::size_t i) {
    return "grain " + std::to_string(bodies.id[i]);
}

bool motion_is_prescribed(const FreeResponse& response) {
    // The fluid answers for such a grain with an inertia of zeros.
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

template <class Mobility>
Mobility mobility_of(const nscd::Bodies& bodies, std::size_t i, const FreeResponse& response,
                     const std::string& when) {
    const auto found = mobility(response, Mobility{});
    if (!found)
        throw PhysicsRefused("the effective inertia of " + grain(bodies, i) +
                             " is not positive definite " + when);
    return *found;
}

template <class Mobility>
std::vector<Mobility> mobilities_of(const nscd::Bodies& bodies,
                                    const std::vector<const FreeResponse*>& responses,
                                    const std::string& when) {
    std::vector<Mobility> result;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const bool held = motion_is_prescribed(*responses[i]);
        demand_agreement(bodies, i, held, when);
        result.push_back(held ? Mobility{} : mobility_of<Mobility>(bodies, i, *responses[i], when));
    }
    return result;
}

}  // namespace

FreeMotion free_motion(const nscd::Bodies& bodies, const std::vector<FreeResponse>& responses,
                       const std::string& when, int dimension) {
    FreeMotion result;
    const auto ordered = by_grain(bodies.id, responses, "response", when);
    if (dimension == 3)
        result.mobilities = mobilities_of<nscd::SpaceMobility>(bodies, ordered, when);
    else
        result.mobilities = mobilities_of<nscd::PlanarTensor>(bodies, ordered, when);
    for (const FreeResponse* response : ordered) {
        const Twist free = twist_of(*response);
        result.velocities.push_back(dimension == 3 ? free : in_plane(free));
    }
    return result;
}

}  // namespace turbidite
