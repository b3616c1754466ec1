// SPDX-License-Identifier: GPL-2.0-or-later
//
// The factors of the eliminations of column_solve.hpp,
//
//     e_0 = 1/d_first,   e_j = 1/(d - e_{j-1}),   e_last = 1/(d_last - e_{last-1})
//
// or, in rows of other heights, e_j = 1/(g_j s + d_j - a_{j-1}^2 e_{j-1}); one per mode and row (a
// row is the values of one y). Where rows are equal, they converge to the fixed point e = (d -
// sqrt(d^2 - 4))/2 as e^(2j): within a few rows for all but the smoothest modes; one with d = 2
// goes to 1 as 1/j and may never settle. Only factors that have not settled are stored, so that a
// settled row costs no memory traffic. Modes settle in order from the one of largest d outwards,
// which is the last mode, or the middle one of a periodic axis. Valid C++17.
#pragma once

#include <cstddef>
#include <vector>

namespace turbidite {

/// The matrix of one row, divided by r: off-diagonals -a_{j-1} and -a_j, diagonal g s + d with s
/// the shift of the mode.
struct EliminationRow {
    double size = 1.0;      ///< g_j
    double diagonal = 2.0;  ///< d_j
    double above = 1.0;     ///< a_j
};

class EliminationFactors {
 public:
    /// Factors for diagonals (over r) of shift[k] + first in the first row, + inner in rows within,
    /// and + last in the last row.
    void compute(const std::vector<double>& shift, double first, double inner, double last,
                 int rows);

    /// The same for any rows. Factors settle in rows with g = 1 and d = 2 between a = 1.
    void compute(const std::vector<double>& shift, const std::vector<EliminationRow>& rows);

    /// Calls range(begin, end, factors) for consecutive ranges that together cover all modes of row
    /// j; factors[k - begin] belongs to mode k.
    template <class Range>
    void for_row(int j, Range range) const {
        const Row& row = rows_[j];
        const double* stored = stored_.data() + row.stored;
        range(0, row.begin, stored);
        range(row.begin, row.end, settled_.data() + row.begin);
        range(row.end, modes_, stored + row.begin);
    }

    std::size_t stored() const { return stored_.size(); }

 private:
    struct Row {
        int begin, end;      // settled modes
        std::size_t stored;  // where the other modes begin in stored_
    };

    void compute(const std::vector<double>& shift, const std::vector<EliminationRow>& rows,
                 double inner);
    void store(const std::vector<double>& factors, int begin, int end);
    bool is_settled(double factor, int mode, int row) const;

    int modes_ = 0;
    std::vector<double> settled_, stored_;
    std::vector<Row> rows_;
};

}  // namespace turbidite
