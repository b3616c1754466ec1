// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/space/wedges.hpp"

namespace turbidite {
namespace {

/// Whether a cell of the sphere `own` is in a wedge for what is beside it: another sphere, a wall,
/// or a cell that is shut in.
bool parts(int own, int beside) {
    return beside != own && beside != CellOwners::none;
}

}  // namespace

void Wedges::clear() {
    in_it_.resize(cells_.cells());
    for (const CellPlace& at : places_) in_it_[number(at)] = 0;
    places_.clear();
}

void Wedges::add_run(const CellPlace& first, int count) {
    const auto [i, j, k] = first;
    const int* here = owners_.row(j, k);
    const int* rows[] = {owners_.row(j - 1, k), owners_.row(j + 1, k), owners_.row(j, k - 1),
                         owners_.row(j, k + 1)};
    const int own = here[i];
    for (int c = i; c < i + count; ++c) {
        bool found = own == CellOwners::shut_in;
        for (const int* row : rows) found |= parts(own, row[c]);
        // Along x a run has others beside its ends alone.
        if (c == i) found |= parts(own, owners_[{i - 1, j, k}]);
        if (c == i + count - 1) found |= parts(own, owners_[{c + 1, j, k}]);
        if (!found) continue;
        places_.push_back({c, j, k});
        in_it_[number(places_.back())] = 1;
    }
}

bool Wedges::has(const CellPlace& at) const {
    const int own = owners_[at];
    if (own == CellOwners::none) return false;
    if (own == CellOwners::shut_in) return true;
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1})
            if (parts(own, owners_[at.beside(axis, side)])) return true;
    return false;
}

/// The same of a cell beside one of this rank's; indices need not be wrapped.
bool Wedges::has_beside(const CellPlace& next) const {
    const CellGrid& grid = *cells_.grid;
    const CellPlace at{grid.wrapped(0, next.i), grid.wrapped(1, next.j), grid.wrapped(2, next.k)};
    if (at.i < 0 || at.j < 0 || at.k < 0) return false;
    return cells_.owns(at.j) ? in_it_[number(at)] != 0 : has(at);
}

/// Whether the cell is of a sphere that forces move; indices need not be wrapped.
bool Wedges::is_free(const CellPlace& at, const std::vector<std::uint8_t>& prescribed) const {
    const int own = owners_[at];
    return own >= 0 && prescribed[static_cast<std::size_t>(own)] == 0;
}

void Wedges::find_sides(const std::vector<std::uint8_t>& prescribed) {
    sides_.clear();
    for (const CellPlace& at : places_) {
        const bool held_here = !is_free(at, prescribed);
        for (const std::int8_t axis : {0, 1, 2})
            for (const std::int8_t side : {-1, 1}) {
                const CellPlace next = at.beside(axis, side);
                if (!has_beside(next)) continue;
                const bool held = held_here && !is_free(next, prescribed);
                sides_.push_back({number(at), axis, side, held});
            }
    }
}

}  // namespace turbidite
