// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Values of all ranks.
#pragma once

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "granular_adapter/nscd/ranks/rank_exchange.hpp"

namespace turbidite::nscd {

template <class T>
RankExchange::Bytes bytes_of(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    RankExchange::Bytes bytes(values.size() * sizeof(T));
    if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

template <class T>
std::vector<T> values_of(const RankExchange::Bytes& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

/// Rank after rank.
template <class T>
std::vector<T> gathered(RankExchange& ranks, const std::vector<T>& mine) {
    std::vector<T> all;
    for (const RankExchange::Bytes& part : ranks.gather(bytes_of(mine))) {
        const std::vector<T> values = values_of<T>(part);
        all.insert(all.end(), values.begin(), values.end());
    }
    return all;
}

template <class T>
std::vector<std::vector<T>> swapped(RankExchange& ranks, const std::vector<std::vector<T>>& parts) {
    std::vector<RankExchange::Bytes> given;
    for (const std::vector<T>& part : parts) given.push_back(bytes_of(part));
    std::vector<std::vector<T>> got;
    for (const RankExchange::Bytes& part : ranks.swap(std::move(given)))
        got.push_back(values_of<T>(part));
    return got;
}

inline double largest(RankExchange& ranks, double mine) {
    const std::vector<double> all = gathered(ranks, std::vector<double>{mine});
    return *std::max_element(all.begin(), all.end());
}

inline bool any(RankExchange& ranks, bool mine) {
    return largest(ranks, mine ? 1.0 : 0.0) > 0.0;
}

}  // namespace turbidite::nscd
