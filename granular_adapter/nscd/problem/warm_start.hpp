// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The impulses of the last step, as the initial guess of the next. A contact is identified by the
// ids of its bodies (or of body and wall key) and its feature, and so survives reordering and
// removal of bodies. Stored is the force J/dt, so that the guess remains right if the length of the
// step changes.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "granular_adapter/nscd/problem/contact_vector.hpp"

namespace turbidite::nscd {

struct ContactKey {
    GrainId first = 0;      ///< smaller body id, or the wall's key
    GrainId second = 0;     ///< larger body id, or the body at the wall
    std::int32_t wall = 0;  ///< 1 if `first` is a wall
    std::int32_t feature = 0;

    auto operator<=>(const ContactKey&) const = default;
};

struct RememberedContact {
    ContactKey key;
    ContactVector force;  ///< J/dt [N]
};

class ContactMemory {
 public:
    /// Replaces the memory by these contacts; `keys` must be distinct. Contacts without impulse are
    /// left out.
    void remember(const std::vector<ContactKey>& keys, const std::vector<ContactVector>& impulses,
                  double step);

    /// The stored force times the step, zero for a new contact.
    ContactVector guess(const ContactKey& key, double step) const;
    std::vector<ContactVector> guesses(const std::vector<ContactKey>& keys, double step) const;

    void forget() { replace({}); }
    const std::vector<RememberedContact>& contacts() const { return contacts_; }
    std::vector<RememberedContact> sorted_by_key() const;
    void replace(std::vector<RememberedContact> contacts);

 private:
    std::vector<RememberedContact> contacts_;  ///< in the order in which they were given
    std::vector<std::int32_t> places_;  ///< open hash table of indices into contacts_; -1: empty
};

}  // namespace turbidite::nscd
