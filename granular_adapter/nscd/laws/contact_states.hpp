// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What laws remember of contacts from step to step: bonds, bridges, sticking. Kept apart from the
// impulses, since most laws remember nothing and some states outlive the impulse.
//
// A step finds the next states; they count once the step is accepted (Engine::move). A step that is
// repeated before that starts from the same states again.
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
    /// Of the last accepted step; zeros for a contact nobody remembers.
    ContactState of(const ContactKey& key) const;

    /// True until a step was accepted: then bonds are made.
    bool initial() const { return !started_; }

    /// What the step found; states of zeros are left out.
    void find(std::vector<RememberedState> next);

    void accept();

    /// Everything, for restart.
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
