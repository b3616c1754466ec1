// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The states of contact laws, kept from step to step: bonds, liquid bridges, sticking. Stored apart
// from the impulses, since most laws have no state and some states outlive the impulse.
//
// A step determines the next states; they take effect when the step is accepted (Engine::move). A
// step that is repeated before that starts from the same states again.
#pragma once

#include <vector>

#include "granular_adapter/nscd/laws/contact_law.hpp"
#include "granular_adapter/nscd/problem/warm_start.hpp"

namespace turbidite::nscd {

struct RememberedState {
    ContactKey key;
    ContactState state{};
};

class ContactStates {
 public:
    /// State at the last accepted step; zeros for an unknown contact.
    ContactState of(const ContactKey& key) const;

    /// The largest value of a slot among all contact points of the pair.
    double largest(const ContactKey& of_pair, LawSlot slot) const;

    /// True until the first step is accepted: in that step bonds are formed.
    bool initial() const { return !started_; }

    /// Stores the states found by a step; states of zeros are dropped.
    void find(std::vector<RememberedState> next);

    /// Makes the states found last those of the accepted step.
    void accept();

    /// The complete memory, for restart.
    struct Saved {
        bool started = false;
        std::vector<RememberedState> accepted;
        std::vector<RememberedState> found;
    };
    Saved saved() const { return {started_, accepted_, found_}; }
    void replace(Saved saved);

 private:
    bool started_ = false;
    std::vector<RememberedState> accepted_;  ///< sorted by key
    std::vector<RememberedState> found_;     ///< sorted by key
};

}  // namespace turbidite::nscd
