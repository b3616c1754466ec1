// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/linear_solvers/elimination_factors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace turbidite {

/// Whether a factor is e within the rounding of the recurrence. The error of a factor is multiplied
/// by e^2 from row to row, so errors add up to about 1/(1 - e^2) roundings, or to one per row where
/// that is fewer: a mode with d = 2 approaches e = 1 as 1/j and, from a dirichlet end, never
/// settles.
bool EliminationFactors::is_settled(double factor, int mode, int row) const {
    const double e = settled_[mode];
    const double per_rounding = std::max(1.0 - e * e, 1.0 / (row + 1));
    return std::abs(factor - e) * per_rounding <= 2.0 * std::numeric_limits<double>::epsilon() * e;
}

void EliminationFactors::store(const std::vector<double>& factors, int begin, int end) {
    rows_.push_back({begin, end, stored_.size()});
    stored_.insert(stored_.end(), factors.begin(), factors.begin() + begin);
    stored_.insert(stored_.end(), factors.begin() + end, factors.end());
}

void EliminationFactors::compute(const std::vector<double>& shift, double first, double inner,
                                 double last, int rows) {
    std::vector<EliminationRow> all(rows, {1.0, inner, 1.0});
    all.front().diagonal = first;
    all.back().diagonal = last;
    compute(shift, all, inner);
}

void EliminationFactors::compute(const std::vector<double>& shift,
                                 const std::vector<EliminationRow>& rows) {
    compute(shift, rows, 2.0);
}

/// `inner`: d of the rows in which factors settle.
void EliminationFactors::compute(const std::vector<double>& shift,
                                 const std::vector<EliminationRow>& rows, double inner) {
    modes_ = static_cast<int>(shift.size());
    rows_.clear();
    stored_.clear();
    settled_.resize(shift.size());
    for (int k = 0; k < modes_; ++k) {
        // d - 2 without cancellation
        const double excess = std::max(shift[k] + (inner - 2.0), 0.0);
        // (d - sqrt(d^2 - 4))/2
        settled_[k] = 2.0 / (2.0 + excess + std::sqrt(excess * (excess + 4.0)));
    }
    const int stiffest =
        static_cast<int>(std::max_element(shift.begin(), shift.end()) - shift.begin());
    const int last = static_cast<int>(rows.size()) - 1;
    std::vector<double> factors(shift.size());
    // The mode of the largest d settles first, its neighbours follow: settled modes are one range.
    int begin = stiffest, end = stiffest;  // modes that have settled, and remain so
    for (int j = 0; j <= last; ++j) {
        const auto& [size, diagonal, above] = rows[j];
        const double below = j > 0 ? rows[j - 1].above : 0.0;
        const bool settles =
            j > 0 && j < last && size == 1.0 && diagonal == inner && below == 1.0 && above == 1.0;
        // A row that differs has factors of its own, and settling begins anew after it.
        if (!settles) begin = end = stiffest;
        // e_j = 1/(g_j s + d_j - a_{j-1}^2 e_{j-1})
        for (int k = 0; k < modes_; ++k)
            // Settled modes keep their last factor; the recurrence goes on from it later.
            if (k < begin || k >= end)
                factors[k] = 1.0 / (size * shift[k] + diagonal - below * below * factors[k]);
        if (!settles) {
            store(factors, modes_, modes_);
            continue;
        }
        while (begin > 0 && is_settled(factors[begin - 1], begin - 1, j)) --begin;
        while (end < modes_ && is_settled(factors[end], end, j)) ++end;
        store(factors, begin, end);
    }
}

}  // namespace turbidite
