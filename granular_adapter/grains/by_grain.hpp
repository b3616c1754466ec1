// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Sorts records sent by the fluid into the order of the bodies; every grain has exactly one record.
#pragma once

#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include "coupler/protocol/records.hpp"

namespace turbidite {

/// One record per id, in the order of `ids`. `what` names the records in errors ("kick"), `when`
/// ends the sentence ("in window 3"). Throws std::runtime_error naming a grain with no record or
/// two, or a record of an unknown grain.
template <class Record>
std::vector<const Record*> by_grain(const std::vector<GrainId>& ids,
                                    const std::vector<Record>& records, const std::string& what,
                                    const std::string& when) {
    const auto grain = [](GrainId id) { return "grain " + std::to_string(id); };
    std::unordered_map<GrainId, std::size_t> place;
    for (std::size_t i = 0; i < ids.size(); ++i) place[ids[i]] = i;
    std::vector<const Record*> result(ids.size(), nullptr);
    for (const Record& record : records) {
        const auto at = place.find(record.id);
        if (at == place.end())
            throw std::runtime_error("a " + what + " was received for " + grain(record.id) +
                                     ", which this rank does not have, " + when);
        if (result[at->second])
            throw std::runtime_error("two " + what + "s were received for " + grain(record.id) +
                                     " " + when);
        result[at->second] = &record;
    }
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (!result[i])
            throw std::runtime_error("no " + what + " was received for " + grain(ids[i]) + " " +
                                     when);
    return result;
}

}  // namespace turbidite
