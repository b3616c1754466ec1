// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/ranks/shared_grains.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace turbidite {
namespace {

constexpr int rows_tag = 6;

int keeper_of(GrainId id, int ranks) {
    // Plates have negative ids; as unsigned numbers they have a keeper too.
    return static_cast<int>(static_cast<std::uint64_t>(id) % ranks);
}

/// Tells every holder of a shared grain about each other holder, as pairs (id, rank).
ByRank<long long> introductions(const ByRank<long long>& held) {
    std::vector<std::pair<long long, int>> holders;
    for (std::size_t rank = 0; rank < held.size(); ++rank)
        for (const long long id : held[rank]) holders.emplace_back(id, static_cast<int>(rank));
    // By id, then by rank: holders of one grain follow each other.
    std::sort(holders.begin(), holders.end());
    ByRank<long long> letters(held.size());
    for (auto first = holders.begin(); first != holders.end();) {
        auto last = first;
        while (last != holders.end() && last->first == first->first) ++last;
        for (auto one = first; one != last; ++one)
            for (auto other = first; other != last; ++other)
                if (one != other) {
                    letters[one->second].push_back(one->first);
                    letters[one->second].push_back(other->second);
                }
        first = last;
    }
    return letters;
}

}  // namespace

void SharedGrains::hold(const GrainId* ids, int count) {
    ByRank<long long> held(group_.size());
    std::unordered_map<GrainId, int> local;
    for (int g = 0; g < count; ++g) {
        held[keeper_of(ids[g], group_.size())].push_back(ids[g]);
        local[ids[g]] = g;
    }
    // Ids to their keepers, and to each holder the others: the only calls among all ranks.
    const ByRank<long long> letters = all_to_all(group_, introductions(all_to_all(group_, held)));

    std::vector<std::pair<int, GrainId>> meetings;
    for (const std::vector<long long>& letter : letters)
        for (std::size_t k = 0; k < letter.size(); k += 2)
            meetings.emplace_back(static_cast<int>(letter[k + 1]), letter[k]);
    // By rank, then by id: both partners have the same order, so that messages need no ids.
    std::sort(meetings.begin(), meetings.end());
    partners_.clear();
    shared_.clear();
    for (const auto& [rank, id] : meetings) {
        if (partners_.empty() || partners_.back().rank != rank) {
            partners_.emplace_back();
            partners_.back().rank = rank;
        }
        partners_.back().grains.push_back(local.at(id));
        shared_.push_back(local.at(id));
    }
    std::sort(shared_.begin(), shared_.end());
    shared_.erase(std::unique(shared_.begin(), shared_.end()), shared_.end());
}

void SharedGrains::sum(double* rows, int per_grain) {
    begin(rows, per_grain);
    own_.clear();
    for (const int g : shared_)
        for (int n = 0; n < per_grain; ++n)
            // Sums begin at zero and take the own values in the place of this rank: a sum depends
            // on its order, and all holders are to have the same bits.
            own_.push_back(std::exchange(rows[g * per_grain + n], 0.0));
    PMPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
    bool own_added = false;
    for (const Partner& partner : partners_) {
        if (!own_added && partner.rank > group_.rank()) {
            add_own(rows, per_grain);
            own_added = true;
        }
        const double* value = partner.received.data();
        for (const int g : partner.grains)
            for (int n = 0; n < per_grain; ++n) rows[g * per_grain + n] += *value++;
    }
    if (!own_added) add_own(rows, per_grain);
}

void SharedGrains::begin(const double* rows, int per_grain) {
    requests_.clear();
    for (Partner& partner : partners_) {
        partner.received.resize(partner.grains.size() * per_grain);
        PMPI_Irecv(partner.received.data(), static_cast<int>(partner.received.size()), MPI_DOUBLE,
                   partner.rank, rows_tag, group_.comm(), &requests_.emplace_back());
    }
    for (Partner& partner : partners_) {
        // A copy: `sum` zeroes the rows while messages are on their way.
        partner.sent.clear();
        for (const int g : partner.grains)
            partner.sent.insert(partner.sent.end(), rows + g * per_grain,
                                rows + (g + 1) * per_grain);
        PMPI_Isend(partner.sent.data(), static_cast<int>(partner.sent.size()), MPI_DOUBLE,
                   partner.rank, rows_tag, group_.comm(), &requests_.emplace_back());
    }
}

void SharedGrains::add_own(double* rows, int per_grain) const {
    const double* value = own_.data();
    for (const int g : shared_)
        for (int n = 0; n < per_grain; ++n) rows[g * per_grain + n] += *value++;
}

}  // namespace turbidite
