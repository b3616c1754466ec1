// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// How grains are shared out among ranks that have none yet: in shares of nearly equal count, in
/// the order of x (and of ids), so that neighbours stay together. Known to both ends where a run
/// goes on with another number of ranks. Valid C++17.
#pragma once

#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

#include "coupler/protocol/records.hpp"

namespace turbidite {

/// The rank of each grain.
inline std::vector<int> even_shares(const std::vector<GrainState>& grains, int ranks) {
    std::vector<std::size_t> order(grains.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&grains](std::size_t a, std::size_t b) {
        return std::make_tuple(grains[a].position[0], grains[a].id) <
               std::make_tuple(grains[b].position[0], grains[b].id);
    });
    std::vector<int> rank(grains.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        rank[order[i]] = static_cast<int>(i * static_cast<std::size_t>(ranks) / order.size());
    return rank;
}

}  // namespace turbidite
