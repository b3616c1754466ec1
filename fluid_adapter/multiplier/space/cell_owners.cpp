// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/space/cell_owners.hpp"

#include <algorithm>

namespace turbidite {

void CellOwners::clear() {
    const std::size_t layer = grid().counts[0] * static_cast<std::size_t>(grid().counts[2]);
    owners_.assign(layer * (cells_.count + 2 * beyond), none);
    no_owners_.assign(grid().counts[0], none);
    walls_.assign(grid().counts[0], wall);
}

/// Place of layer j among those known, or -1.
int CellOwners::layer(int j) const {
    const int known = cells_.count + 2 * beyond, ny = grid().counts[1];
    int at = j - cells_.first + beyond;
    // Of a cyclic axis also those round the grid.
    if (grid().cyclic(1) && at < 0) at += ny;
    if (grid().cyclic(1) && at >= known) at -= ny;
    return at >= 0 && at < known ? at : -1;
}

std::size_t CellOwners::number(const CellPlace& at) const {
    return at.i +
           grid().counts[0] * (at.k + static_cast<std::size_t>(grid().counts[2]) * layer(at.j));
}

bool CellOwners::knows_beside(int j) const {
    const auto known = [&](int beside) {
        const int layer = grid().wrapped(1, beside);
        return layer < 0 || knows(layer);
    };
    return knows(j) && known(j - 1) && known(j + 1);
}

void CellOwners::set(const CellPlace& first, int count, int owner) {
    if (knows(first.j)) std::fill_n(owners_.begin() + number(first), count, owner);
}

/// What stands for an owner there; 0 in the grid.
int CellOwners::beyond_side(int axis, int at) const {
    if (grid().wrapped(axis, at) >= 0) return 0;
    return grid().sides[axis][at < 0 ? 0 : 1] == Side::wall ? wall : none;
}

const int* CellOwners::row(int j, int k) const {
    for (const int beyond : {beyond_side(1, j), beyond_side(2, k)})
        if (beyond != 0) return (beyond == wall ? walls_ : no_owners_).data();
    return owners_.data() + number({0, grid().wrapped(1, j), grid().wrapped(2, k)});
}

int CellOwners::operator[](const CellPlace& at) const {
    if (const int beyond = beyond_side(0, at.i); beyond != 0) return beyond;
    return row(at.j, at.k)[grid().wrapped(0, at.i)];
}

}  // namespace turbidite
