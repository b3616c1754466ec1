// SPDX-License-Identifier: GPL-2.0-or-later
//
// Redistribution between the cells of a rank, from any decomposition, and the complete rows that a
// separable solve needs. A row is all cells with the same y. If every rank already has complete,
// contiguous rows, as with `simple (1 n 1)`, these are used and nothing is communicated. Otherwise
// rows are distributed evenly, and each cell in another rank's row is sent once per direction.
// Valid C++17.
#pragma once

#include <memory>
#include <vector>

#include "fluid_adapter/linear_solvers/pencils.hpp"
#include "fluid_adapter/ranks/rank_group.hpp"

namespace turbidite {

class CellRows {
 public:
    /// `cells`: the number i + columns j of each of this rank's cells, in the rank's order. Throws
    /// std::invalid_argument, on every rank, unless every cell belongs to exactly one rank.
    CellRows(const RankGroup& group, int columns, int rows, const std::vector<int>& cells);

    /// Arrays for a separable solve on these rows.
    std::unique_ptr<Pencils> pencils() const;

    /// Spans of y, one per rank.
    const std::vector<Span>& rows_of_rank() const { return rows_of_rank_; }

    /// rows[...] = value_of(c) for every cell c of this rank, on whichever rank its row is.
    template <class ValueOf>
    void gather(ValueOf value_of, double* rows);

    /// put(c, value) for every cell c of this rank.
    template <class Put>
    void scatter(const double* rows, Put put);

    /// The value of cell (0, 0), on every rank.
    double first(const double* rows) const;

    /// Of this rank's complete rows.
    int size() const { return columns_ * rows_of_rank_[group_.rank()].count; }

    /// The rank's cells are its rows, in the same order.
    bool in_cell_order() const { return straight_; }

    /// No value travels between ranks.
    bool stays() const { return away_.empty() && received_.empty(); }

 private:
    struct Part {  // section of a buffer, for one other rank
        int rank, begin, end;
    };

    void choose_rows(int rows, const std::vector<int>& cells);
    void sort_cells(const std::vector<int>& cells);
    void check_complete() const;
    int row_holder(int row) const;
    void begin_exchange(const std::vector<Part>& out, double* out_values,
                        const std::vector<Part>& in, double* in_values);
    void end_exchange();

    RankGroup group_;
    int columns_;
    std::vector<Span> rows_of_rank_;
    // All cells stay, and are already in the order of the rows: they need no lists.
    bool straight_ = false;
    std::vector<int> own_cells_, own_places_;  // cells that stay, and their places in the rows
    std::vector<Part> away_, received_;        // sections of the next two lists
    std::vector<int> away_cells_;              // cells whose rows are on another rank
    std::vector<int> received_places_;         // places in the rows of cells from other ranks
    std::vector<double> away_values_, received_values_;
    std::vector<MPI_Request> requests_;
};

template <class ValueOf>
void CellRows::gather(ValueOf value_of, double* rows) {
    if (straight_) {
        for (int c = 0; c < size(); ++c) rows[c] = value_of(c);
        return;
    }
    for (std::size_t k = 0; k < away_cells_.size(); ++k) away_values_[k] = value_of(away_cells_[k]);
    begin_exchange(away_, away_values_.data(), received_, received_values_.data());
    for (std::size_t k = 0; k < own_cells_.size(); ++k)
        rows[own_places_[k]] = value_of(own_cells_[k]);
    end_exchange();
    for (std::size_t k = 0; k < received_places_.size(); ++k)
        rows[received_places_[k]] = received_values_[k];
}

template <class Put>
void CellRows::scatter(const double* rows, Put put) {
    if (straight_) {
        for (int c = 0; c < size(); ++c) put(c, rows[c]);
        return;
    }
    for (std::size_t k = 0; k < received_places_.size(); ++k)
        received_values_[k] = rows[received_places_[k]];
    begin_exchange(received_, received_values_.data(), away_, away_values_.data());
    for (std::size_t k = 0; k < own_cells_.size(); ++k) put(own_cells_[k], rows[own_places_[k]]);
    end_exchange();
    for (std::size_t k = 0; k < away_cells_.size(); ++k) put(away_cells_[k], away_values_[k]);
}

}  // namespace turbidite
