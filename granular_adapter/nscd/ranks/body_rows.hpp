// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Chosen entries of several arrays as bytes, and back. `visit(each)` calls each(array) for every
// array, always in the same order.
#pragma once

#include <algorithm>
#include <numeric>

#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/byte_stream.hpp"

namespace turbidite::nscd {

template <class Visit>
std::vector<char> rows_of(const std::vector<std::int32_t>& chosen, const Visit& visit) {
    ByteWriter out;
    out.value(static_cast<std::uint64_t>(chosen.size()));
    visit([&](const auto& array) {
        for (const std::int32_t i : chosen) out.value(array[static_cast<std::size_t>(i)]);
    });
    return out.take();
}

/// Appends them to the arrays; returns how many there are.
template <class Visit>
std::size_t append_rows(const std::vector<char>& bytes, const Visit& visit) {
    if (bytes.empty()) return 0;
    ByteReader in(bytes);
    const auto count = in.value<std::uint64_t>();
    visit([&](auto& array) {
        using Entry = typename std::decay_t<decltype(array)>::value_type;
        for (std::uint64_t i = 0; i < count; ++i) array.push_back(in.value<Entry>());
    });
    return static_cast<std::size_t>(count);
}

inline std::vector<std::int32_t> order_of_ids(const Bodies& bodies) {
    std::vector<std::int32_t> order(bodies.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
        return bodies.id[static_cast<std::size_t>(a)] < bodies.id[static_cast<std::size_t>(b)];
    });
    return order;
}

/// The entries in another order, those left out dropped.
template <class Visit>
void take_rows(const std::vector<std::int32_t>& order, const Visit& visit) {
    visit([&](auto& array) {
        std::decay_t<decltype(array)> taken;
        taken.reserve(order.size());
        for (const std::int32_t i : order) taken.push_back(array[static_cast<std::size_t>(i)]);
        array = std::move(taken);
    });
}

}  // namespace turbidite::nscd
