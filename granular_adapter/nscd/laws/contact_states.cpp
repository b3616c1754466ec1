// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/contact_states.hpp"

#include <algorithm>
#include <limits>

namespace turbidite::nscd {
namespace {

bool by_key(const RememberedState& a, const RememberedState& b) {
    return a.key < b.key;
}

}  // namespace

ContactState ContactStates::of(const ContactKey& key) const {
    const auto at =
        std::lower_bound(accepted_.begin(), accepted_.end(), RememberedState{key, {}}, by_key);
    return at != accepted_.end() && at->key == key ? at->state : ContactState{};
}

double ContactStates::largest(const ContactKey& of_pair, LawSlot slot) const {
    ContactKey lowest = of_pair;
    lowest.feature = std::numeric_limits<std::int32_t>::min();
    auto at =
        std::lower_bound(accepted_.begin(), accepted_.end(), RememberedState{lowest, {}}, by_key);
    const auto same_pair = [&] {
        return at->key.first == of_pair.first && at->key.second == of_pair.second &&
               at->key.wall == of_pair.wall;
    };
    double value = 0.0;
    for (; at != accepted_.end() && same_pair(); ++at)
        value = std::max(value, at->state[static_cast<std::size_t>(slot)]);
    return value;
}

void ContactStates::find(std::vector<RememberedState> next) {
    std::erase_if(next, [](const RememberedState& s) { return s.state == ContactState{}; });
    std::sort(next.begin(), next.end(), by_key);
    found_ = std::move(next);
}

void ContactStates::accept() {
    started_ = true;
    // `found_` stays: another move without a new step leaves the states as they are.
    accepted_ = found_;
}

void ContactStates::replace(Saved saved) {
    started_ = saved.started;
    accepted_ = std::move(saved.accepted);
    found_ = std::move(saved.found);
}

}  // namespace turbidite::nscd
