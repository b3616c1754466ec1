// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The cells of a problem's contacts (cells/cell_order.hpp): contacts of one cell follow each other.
// Sums over contacts are made cell by cell and then over the cells in their order, so that any
// number of ranks finds the same.
#pragma once

#include <cstdint>
#include <vector>

namespace turbidite::nscd {

struct ContactCells {
    std::vector<std::uint64_t> place;  ///< of the cell among all cells of the world, in their order
    std::vector<std::int32_t> end;     ///< the number of contacts up to the end of the cell

    std::size_t size() const { return end.size(); }
    bool empty() const { return end.empty(); }
    std::int32_t first(std::size_t cell) const { return cell == 0 ? 0 : end[cell - 1]; }
};

}  // namespace turbidite::nscd
