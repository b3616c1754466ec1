// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Sums over the contacts of a problem: over those of a cell, then over the cells in their order,
// those of all ranks included; on one rank in the plane over all contacts in turn.
#pragma once

#include <algorithm>
#include <numeric>

#include "granular_adapter/nscd/problem/contact_problem.hpp"

namespace turbidite::nscd {

/// Adds what the cells of all ranks have, given one entry per cell of this rank. Sums: plain
/// numbers with add(Sums); collective.
template <class Sums>
Sums sum_over_cells(const ContactProblem& problem, const std::vector<Sums>& of_cells) {
    struct Entry {
        std::uint64_t place;
        Sums sums;
    };
    Sums total{};
    if (!problem.ranks) {
        for (const Sums& cell : of_cells) total.add(cell);
        return total;
    }
    std::vector<Entry> mine;
    for (std::size_t cell = 0; cell < of_cells.size(); ++cell)
        mine.push_back({problem.cells.place[cell], of_cells[cell]});
    std::vector<Entry> all = gathered(problem.ranks->ranks(), mine);
    std::sort(all.begin(), all.end(),
              [](const Entry& x, const Entry& y) { return x.place < y.place; });
    for (const Entry& entry : all) total.add(entry.sums);
    return total;
}

/// add(sums, k) for every contact k.
template <class Sums, class Add>
Sums sum_over_contacts(const ContactProblem& problem, const Add& add) {
    Sums total{};
    if (problem.cells.empty() && !problem.ranks) {
        for (std::size_t k = 0; k < problem.contacts.size(); ++k) add(total, k);
        return total;
    }
    std::vector<Sums> of_cells(problem.cells.size());
    for (std::size_t cell = 0, k = 0; cell < of_cells.size(); ++cell)
        for (; k < static_cast<std::size_t>(problem.cells.end[cell]); ++k) add(of_cells[cell], k);
    return sum_over_cells(problem, of_cells);
}

}  // namespace turbidite::nscd
