// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Position of a grain in a list of grains. The lists of successive windows usually contain the
/// same grains, so an index is kept as long as it is valid. Valid C++17.
#pragma once

#include <algorithm>
#include <unordered_map>
#include <vector>

#include "coupler/protocol/records.hpp"

namespace turbidite {

/// The places of ids in a list of grains.
class GrainIndex {
 public:
    /// The place of an id that is not in the list.
    static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

    GrainIndex() = default;
    explicit GrainIndex(const std::vector<GrainState>& grains) { follow(grains); }

    /// Returns the first id that occurs twice, if any; the index is then invalid.
    std::optional<GrainId> follow(const std::vector<GrainState>& grains) {
        if (fits(grains)) return std::nullopt;
        ++builds_;
        ids_.clear();
        places_.clear();
        places_.reserve(grains.size());
        for (const GrainState& grain : grains) {
            if (!places_.emplace(grain.id, ids_.size()).second) return grain.id;
            ids_.push_back(grain.id);
        }
        return std::nullopt;
    }

    /// How often it was built anew: whenever the ids or their order changed.
    std::int64_t builds() const { return builds_; }

    /// Whether it is of these grains in this order.
    bool fits(const std::vector<GrainState>& grains) const {
        return std::equal(ids_.begin(), ids_.end(), grains.begin(), grains.end(),
                          [](GrainId id, const GrainState& grain) { return id == grain.id; });
    }

    std::size_t size() const { return ids_.size(); }
    GrainId id(std::size_t place) const { return ids_[place]; }

    /// `nowhere` for an id that is not in the list.
    std::size_t place(GrainId id) const {
        const auto at = places_.find(id);
        return at == places_.end() ? nowhere : at->second;
    }

    /// The same, faster if `guess` is right: the place after that of the previous grain.
    std::size_t place(GrainId id, std::size_t guess) const {
        return guess < ids_.size() && ids_[guess] == id ? guess : place(id);
    }

 private:
    std::int64_t builds_ = 0;
    std::vector<GrainId> ids_;
    std::unordered_map<GrainId, std::size_t> places_;
};

}  // namespace turbidite
