// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/checks/contact_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace turbidite {
namespace {

const std::string one_report_per_contact =
    "Every contact is reported once, by one of the ranks that have its grains, and only those of "
    "grains of the state.";
const std::string all_or_none =
    "In a window either all ranks report their contacts, those without any an empty list, or none.";

struct Reported {
    const ContactRecord* contact;
    int rank;
};

std::string name_of(const ContactRecord& contact) {
    const std::string first = contact.wall < 0 ? fmt::format("grain {}", contact.a)
                                               : fmt::format("wall {}", contact.wall);
    return fmt::format("the contact of {} and grain {} (point {})", first, contact.b,
                       contact.feature);
}

/// Of all ranks, in the order of contact_before; those of one contact in the order of the ranks.
// Pointers: contacts stay where they are, since the shares are merged only after this check.
std::vector<Reported> in_order(const std::vector<Motion>& shares) {
    std::vector<Reported> all;
    for (std::size_t rank = 0; rank < shares.size(); ++rank)
        for (const ContactRecord& contact : *shares[rank].contacts)
            all.push_back({&contact, static_cast<int>(rank)});
    std::stable_sort(all.begin(), all.end(), [](const Reported& x, const Reported& y) {
        return contact_before(*x.contact, *y.contact);
    });
    return all;
}

std::optional<GrainId> unknown_grain(const ContactRecord& contact, const GrainRoster& roster) {
    // At a wall only b is a grain; a is undefined there.
    if (!roster.has(contact.b)) return contact.b;
    if (contact.wall < 0 && !roster.has(contact.a)) return contact.a;
    return std::nullopt;
}

}  // namespace

void check_contacts(const std::vector<Motion>& shares, const GrainRoster& roster,
                    const Arrival& arrival) {
    const auto silent = std::find_if(shares.begin(), shares.end(),
                                     [](const Motion& share) { return !share.contacts; });
    const auto tells = [](const Motion& share) { return share.contacts.has_value(); };
    // No rank tells, in windows without output or from programs that cannot. Some but not all would
    // make sums over contacts wrong.
    if (std::none_of(shares.begin(), shares.end(), tells)) return;
    if (silent != shares.end())
        arrival.refuse(static_cast<int>(silent - shares.begin()),
                       "no contacts were sent, but other ranks sent theirs", all_or_none);
    const std::vector<Reported> all = in_order(shares);
    for (std::size_t k = 0; k < all.size(); ++k) {
        const auto& [contact, rank] = all[k];
        if (const auto unknown = unknown_grain(*contact, roster))
            arrival.refuse(rank,
                           fmt::format("{} names grain {}, which is not in the run",
                                       name_of(*contact), *unknown),
                           one_report_per_contact);
        // In this order, two that follow each other and are not before each other are the same
        // contact.
        if (k > 0 && !contact_before(*all[k - 1].contact, *contact))
            arrival.refuse(rank,
                           fmt::format("{} was sent twice, first by rank {}", name_of(*contact),
                                       all[k - 1].rank),
                           one_report_per_contact);
    }
}

}  // namespace turbidite
