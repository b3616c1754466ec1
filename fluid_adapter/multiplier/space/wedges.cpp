// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/space/wedges.hpp"

namespace turbidite {

void Wedges::add_run(const CellPlace& first, int count) {
    for (int c = 0; c < count; ++c)
        if (const CellPlace at = first.beside(0, c); has(at)) add(at);
}

bool Wedges::has(const CellPlace& at) const {
    const int own = owners_[at];
    if (own == CellOwners::none) return false;
    if (own == CellOwners::shut_in) return true;
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1})
            // Another sphere, a wall, or a cell that is shut in
            if (const int other = owners_[at.beside(axis, side)];
                other != own && other != CellOwners::none)
                return true;
    return false;
}

void Wedges::add(const CellPlace& at) {
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1}) {
            const CellPlace next = at.beside(axis, side);
            if (owners_[next] != CellOwners::wall && has(next))
                sides_.push_back({cells_.cell(at.i, at.j, at.k), axis, side});
        }
}

}  // namespace turbidite
