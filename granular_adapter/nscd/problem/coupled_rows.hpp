// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The Delassus operator W = H^T M^-1 H (Topin 2011, Eq. 19), assembled in block compressed row
// storage: one block for every pair of contacts that share a movable body [1/kg]. The same for
// every kind of contact; the kind says what a block is:
//
//     Block::Mobility                        M^-1 of a body
//     Block::End                             H_k of one of the two bodies, with the index `contact`
//     Block::end_of(contact, index, at_b)    makes an end
//     Block::share(body, row, column)        H_k^T M^-1 H_j of this body alone
//     Block::transposed(block)
//     block += share
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "granular_adapter/nscd/problem/contact_problem.hpp"

namespace turbidite::nscd {

/// The blocks off the diagonal.
template <class Block>
struct CoupledRows {
    std::vector<std::int64_t> row_start;  ///< of block row k in the arrays below; one more entry
    std::vector<std::int32_t> column;     ///< block column j != k, ascending within a row
    std::vector<Block> coupling;          ///< W_kj
};

/// The contacts of every movable body, in order.
template <class Block>
std::vector<std::vector<typename Block::End>> ends_by_body(
    const ContactProblem& problem, const std::vector<typename Block::Mobility>& bodies) {
    std::vector<std::vector<typename Block::End>> ends(bodies.size());
    const auto add = [&](std::int32_t body, std::int32_t k, bool at_b) {
        if (body < 0) return;
        // An immovable body couples no contacts: M^-1 = 0.
        if (!is_immovable(bodies[body]))
            ends[body].push_back(Block::end_of(problem.contacts[k], k, at_b));
    };
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(problem.contacts.size()); ++k) {
        add(problem.contacts[k].a, k, false);
        add(problem.contacts[k].b, k, true);
    }
    return ends;
}

template <class Block>
struct RowEntry {
    std::int32_t column;
    Block share;
    bool operator<(const RowEntry& other) const { return column < other.column; }
};

/// Contributions of one body to block row k. Always computed as W_ij with i < j, so that both
/// halves of W round alike.
template <class Block>
void collect(std::vector<RowEntry<Block>>& row, const typename Block::Mobility& body,
             const std::vector<typename Block::End>& ends, std::int32_t k) {
    const auto own =
        std::lower_bound(ends.begin(), ends.end(), k,
                         [](const auto& end, std::int32_t i) { return end.contact < i; });
    for (const auto& other : ends) {
        if (other.contact == k) continue;
        row.push_back({other.contact, k < other.contact
                                          ? Block::share(body, *own, other)
                                          : Block::transposed(Block::share(body, other, *own))});
    }
}

/// Appends block row k to those before it.
template <class Block>
void append(std::vector<RowEntry<Block>>& row, CoupledRows<Block>& rows) {
    // Stable: two contacts that share both bodies get their shares in the order a, b.
    std::stable_sort(row.begin(), row.end());
    for (const RowEntry<Block>& entry : row) {
        const bool same = std::int64_t(rows.column.size()) > rows.row_start.back() &&
                          rows.column.back() == entry.column;  // the contacts share both bodies
        if (!same) rows.column.push_back(entry.column), rows.coupling.emplace_back();
        rows.coupling.back() += entry.share;
    }
    rows.row_start.push_back(static_cast<std::int64_t>(rows.column.size()));
}

template <class Block>
CoupledRows<Block> coupled_rows(const ContactProblem& problem,
                                const std::vector<typename Block::Mobility>& bodies) {
    const auto ends = ends_by_body<Block>(problem, bodies);
    CoupledRows<Block> rows;
    rows.row_start.push_back(0);
    std::vector<RowEntry<Block>> row;
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(problem.contacts.size()); ++k) {
        row.clear();
        for (const std::int32_t body : {problem.contacts[k].a, problem.contacts[k].b})
            if (body >= 0 && !ends[body].empty()) collect<Block>(row, bodies[body], ends[body], k);
        append(row, rows);
    }
    return rows;
}

}  // namespace turbidite::nscd
