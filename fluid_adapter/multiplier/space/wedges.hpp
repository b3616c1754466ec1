// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The wedges between spheres that touch on the mesh, or touch a wall: cells beside a cell of
// another sphere, beside a wall or beside a cell that is shut in, and these. The faces between two
// of them carry a film of liquid (box_step/wedge_flow.hpp). Valid C++17.
#pragma once

#include <cstdint>
#include <vector>

#include "fluid_adapter/multiplier/cell_side.hpp"
#include "fluid_adapter/multiplier/space/cell_owners.hpp"

namespace turbidite {

class Wedges {
 public:
    /// Keeps both by reference.
    Wedges(const LayerCells& cells, const CellOwners& owners) : cells_(cells), owners_(owners) {}

    /// Begins anew, when the owners are known.
    void clear();

    /// Adds those of `count` cells along x of this rank, which are spheres' or shut in.
    void add_run(const CellPlace& first, int count);

    /// When all runs have been added. `prescribed`: of the spheres, by index.
    void find_sides(const std::vector<std::uint8_t>& prescribed);

    /// Faces between two cells of wedges, from every one of them that is this rank's.
    const std::vector<CellSide>& sides() const { return sides_; }

 private:
    bool has(const CellPlace& at) const;
    bool has_beside(const CellPlace& next) const;
    bool is_free(const CellPlace& at, const std::vector<std::uint8_t>& prescribed) const;
    int number(const CellPlace& at) const { return cells_.cell(at.i, at.j, at.k); }

    const LayerCells& cells_;
    const CellOwners& owners_;
    std::vector<CellPlace> places_;    // of this rank's cells in wedges
    std::vector<std::uint8_t> in_it_;  // by cell of this rank
    std::vector<CellSide> sides_;
};

}  // namespace turbidite
