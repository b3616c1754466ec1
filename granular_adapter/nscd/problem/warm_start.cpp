// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/warm_start.hpp"

#include <algorithm>
#include <bit>

namespace turbidite::nscd {
namespace {

bool by_key(const RememberedContact& a, const RememberedContact& b) {
    return a.key < b.key;
}

// The table is prefetched this many keys ahead: positions in it are unrelated to the order of the
// contacts, so that every look-up would miss the cache.
constexpr std::size_t ahead = 16;

// Keys are looked up in the order of a step's contacts, which is unrelated to the order of the
// keys: a binary search would miss the cache a dozen times per contact.
std::size_t scrambled(const ContactKey& key) {
    std::uint64_t h = static_cast<std::uint64_t>(key.first) * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 32) ^ static_cast<std::uint64_t>(key.second)) * 0x9e3779b97f4a7c15u;
    const auto rest = static_cast<std::uint64_t>(key.feature) * 2 + (key.wall != 0 ? 1 : 0);
    h = (h ^ (h >> 32) ^ rest) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(h ^ (h >> 32));
}

std::vector<std::int32_t> hash_table(const std::vector<RememberedContact>& contacts) {
    if (contacts.empty()) return {};
    // At most half full, so that a search ends after few steps; a power of two, so that & replaces
    // the remainder.
    std::vector<std::int32_t> places(std::bit_ceil(2 * contacts.size()), -1);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        std::size_t at = scrambled(contacts[i].key);
        // Linear probing: the next free place.
        while (places[at & (places.size() - 1)] >= 0) ++at;
        places[at & (places.size() - 1)] = static_cast<std::int32_t>(i);
    }
    return places;
}

}  // namespace

void ContactMemory::remember(const std::vector<ContactKey>& keys,
                             const std::vector<ContactVector>& impulses, double step) {
    std::vector<RememberedContact> contacts;
    contacts.reserve(contacts_.size());
    for (std::size_t k = 0; k < keys.size(); ++k)
        if (impulses[k].n != 0.0) contacts.push_back({keys[k], (1.0 / step) * impulses[k]});
    replace(std::move(contacts));
}

ContactVector ContactMemory::guess(const ContactKey& key, double step) const {
    if (places_.empty()) return {};
    for (std::size_t at = scrambled(key);; ++at) {
        const std::int32_t place = places_[at & (places_.size() - 1)];
        if (place < 0) return {};
        const RememberedContact& contact = contacts_[static_cast<std::size_t>(place)];
        if (contact.key == key) return step * contact.force;
    }
}

std::vector<ContactVector> ContactMemory::guesses(const std::vector<ContactKey>& keys,
                                                  double step) const {
    std::vector<ContactVector> result;
    if (places_.empty()) return std::vector<ContactVector>(keys.size());
    result.reserve(keys.size());
    for (std::size_t k = 0; k < keys.size(); ++k) {
        if (k + ahead < keys.size())
            __builtin_prefetch(&places_[scrambled(keys[k + ahead]) & (places_.size() - 1)]);
        result.push_back(guess(keys[k], step));
    }
    return result;
}

std::vector<RememberedContact> ContactMemory::sorted_by_key() const {
    std::vector<RememberedContact> result = contacts_;
    std::sort(result.begin(), result.end(), by_key);
    return result;
}

void ContactMemory::replace(std::vector<RememberedContact> contacts) {
    contacts_ = std::move(contacts);
    places_ = hash_table(contacts_);
}

}  // namespace turbidite::nscd
