// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the multiplier method asks of a fluid: velocities in the cells of a rectilinear grid, the
// mass that answers for them, and sums over the ranks that share the grid. A rank sees its own
// cells and a halo of at least two layers; both have local indices. Valid C++17.
#pragma once

#include "coupler/protocol/records.hpp"
#include "fluid_adapter/multiplier/cell_grid.hpp"
#include "fluid_adapter/multiplier/cell_table.hpp"

namespace turbidite {

class FluidField {
 public:
    virtual ~FluidField() = default;

    /// The whole grid, over all ranks.
    virtual const CellGrid& grid() const = 0;

    /// Local index of a cell, halo included; -1 where this rank knows nothing of it.
    int cell(int i, int j, int k) const {
        const std::array<int, 3>& counts = grid().counts;
        const bool inside = i >= 0 && j >= 0 && k == 0 && i < counts[0] && j < counts[1];
        return inside ? cells().at(i, j) : -1;
    }

    /// The same for cells of the grid, unchecked and fast.
    virtual const CellTable& cells() const = 0;

    virtual int local_cells() const = 0;  ///< owned and halo cells
    virtual bool owns(int cell) const = 0;

    /// rho_f V of a cell with the edges grid().spacing [kg]; per unit length in two dimensions.
    virtual double reference_mass() const = 0;

    /// rho_f V_c [kg], the same.
    double cell_mass(int i, int j) const { return reference_mass() * grid().relative_volume(i, j); }

    /// One component of velocity, contiguous over local cells [m/s].
    virtual double* velocity(int axis) = 0;

    /// Other ranks know the cell too: it is in this one's halo or in another's.
    virtual bool shares(int) const { return false; }

    /// Owners' values of both components to the halos of the others.
    virtual void import_halo(double*, double*) const {}

    /// Adds up what ranks have in cells that several know, and gives the sum to all of them. Both
    /// components are by local cell, and zero where the rank has nothing to say.
    virtual void share_sums(double*, double*) const {}

    /// Sums over the ranks of the fluid, in place.
    virtual void sum_over_ranks(double*, int) const {}

    /// The grains this rank holds, before their first sum over holders; by every rank.
    virtual void hold_grains(const GrainId*, int) const {}

    /// Sums, in place, the rows of grains that more than one rank holds: so many numbers for each
    /// grain of `hold_grains`, in its order. The same bits for every holder.
    virtual void sum_over_holders(double*, int) const {}
};

}  // namespace turbidite
