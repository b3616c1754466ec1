// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/space/cell_owners.hpp"

namespace turbidite {

void CellOwners::clear() {
    const std::size_t layer = grid().counts[0] * static_cast<std::size_t>(grid().counts[2]);
    owners_.assign(layer * (cells_.count + 2 * beyond), none);
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

void CellOwners::set(const CellPlace& at, int owner) {
    if (knows(at.j)) owners_[number(at)] = owner;
}

int CellOwners::operator[](const CellPlace& at) const {
    const std::array<int, 3> place{at.i, at.j, at.k};
    std::array<int, 3> in;
    for (int axis = 0; axis < 3; ++axis) {
        in[axis] = grid().wrapped(axis, place[axis]);
        if (in[axis] >= 0) continue;
        return grid().sides[axis][place[axis] < 0 ? 0 : 1] == Side::wall ? wall : none;
    }
    return owners_[number({in[0], in[1], in[2]})];
}

}  // namespace turbidite
