// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/sweeps/plane/sweep_layout.hpp"

namespace turbidite::nscd {
namespace {

bool immovable(const BodyMobility& m) {
    return m.xx == 0.0 && m.yy == 0.0 && m.ss == 0.0;
}

}  // namespace

MovedBodies::MovedBodies(const ContactProblem& problem) : moved_(problem.bodies.size()) {
    for (std::size_t i = 0; i < moved_.size(); ++i)
        moved_[i] = immovable(problem.bodies[i]) ? -1 : static_cast<std::int32_t>(i);
}

std::vector<MovedPair> moved_pairs(const ContactProblem& problem) {
    const MovedBodies moved(problem);
    std::vector<MovedPair> pairs;
    pairs.reserve(problem.contacts.size());
    for (const Contact& contact : problem.contacts) pairs.push_back(moved.of(contact));
    return pairs;
}

}  // namespace turbidite::nscd
