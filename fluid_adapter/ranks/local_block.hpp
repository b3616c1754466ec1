// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The local index of cell (i, j) on a rank: its own cells first, in its own order, then a halo of
// all cells within a number of layers of them (diagonally as well). One number is stored per cell
// of the smallest block of the grid that contains both. Beyond a cyclic side follow the cells of
// the opposite side. Valid C++17.
#pragma once

#include <array>
#include <vector>

#include "fluid_adapter/multiplier/cell_grid.hpp"
#include "fluid_adapter/multiplier/cell_table.hpp"

namespace turbidite {

class LocalBlock {
 public:
    /// `own`: the number i + nx j of each of this rank's cells. Determines the halo, without
    /// numbering it.
    LocalBlock(const CellGrid& grid, const std::vector<int>& own, int layers);

    /// Numbers of the halo's cells, ascending.
    const std::vector<int>& halo() const { return halo_; }

    /// Gives the halo cells the local indices after the own ones, in this order.
    void number_halo(const std::vector<int>& order);

    /// Local index of a cell of the grid; -1 if this rank does not know the cell.
    int at(int i, int j) const { return table().at(i, j); }

    /// Valid as long as the block stays where it is.
    CellTable table() const {
        return {index_.data(), first_, width_, turn_, first_counted_, counted_rows_};
    }

 private:
    int& slot(int i, int j) {
        const CellTable cells = table();
        return index_[cells.along(0, i) + static_cast<std::size_t>(width_[0]) * cells.along(1, j)];
    }

    void enclose(const std::vector<int>& own, int layers);
    bool is_inside(int cell) const;
    void mark_around(int cell, int layers);
    void count_rows();

    CellGrid grid_;
    std::array<int, 2> first_{}, width_{};
    std::array<int, 2> turn_{};                 // cells around a cyclic axis, 0 for others
    int first_counted_ = 0, counted_rows_ = 0;  // cell_table.hpp
    std::vector<int> index_;
    std::vector<int> halo_;
    int own_count_;
};

}  // namespace turbidite
