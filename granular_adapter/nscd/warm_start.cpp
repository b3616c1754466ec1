// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/warm_start.hpp"

#include <algorithm>

#include "granular_adapter/nscd/vec3.hpp"

namespace turbidite::nscd {
namespace {

bool by_key(const RememberedContact& a, const RememberedContact& b) {
    return a.key < b.key;
}

}  // namespace

void ContactMemory::remember(const std::vector<ContactKey>& keys, const std::vector<Vec3>& impulses,
                             double step) {
    std::vector<RememberedContact> contacts;
    for (std::size_t k = 0; k < keys.size(); ++k)
        if (impulses[k][0] > 0.0) contacts.push_back({keys[k], (1.0 / step) * impulses[k]});
    replace(std::move(contacts));
}

Vec3 ContactMemory::guess(const ContactKey& key, double step) const {
    const auto at =
        std::lower_bound(contacts_.begin(), contacts_.end(), RememberedContact{key, {}}, by_key);
    return at != contacts_.end() && at->key == key ? step * at->force : Vec3{};
}

void ContactMemory::replace(std::vector<RememberedContact> contacts) {
    contacts_ = std::move(contacts);
    std::sort(contacts_.begin(), contacts_.end(), by_key);
}

}  // namespace turbidite::nscd
