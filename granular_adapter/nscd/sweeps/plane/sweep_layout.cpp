// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/sweeps/plane/sweep_layout.hpp"

namespace turbidite::nscd {
namespace {

bool immovable(const BodyMobility& m) {
    return m.xx == 0.0 && m.yy == 0.0 && m.ss == 0.0;
}

}  // namespace

std::vector<MovedPair> moved_pairs(const ContactProblem& problem) {
    std::vector<std::int32_t> moved(problem.bodies.size());
    for (std::size_t i = 0; i < moved.size(); ++i)
        moved[i] = immovable(problem.bodies[i]) ? -1 : static_cast<std::int32_t>(i);
    std::vector<MovedPair> pairs;
    pairs.reserve(problem.contacts.size());
    for (const Contact& contact : problem.contacts)
        pairs.push_back({contact.a < 0 ? -1 : moved[static_cast<std::size_t>(contact.a)],
                         moved[static_cast<std::size_t>(contact.b)]});
    return pairs;
}

}  // namespace turbidite::nscd
