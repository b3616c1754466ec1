// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the multiplier method needs from a fluid: velocities in the cells of a rectilinear grid, the
// mass of the cells, and sums over the ranks that share the grid. A rank sees its own cells and a
// halo of at least two layers; both have local indices. Valid C++17.
#pragma once

#include <array>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "fluid_adapter/multiplier/cell_grid.hpp"
#include "fluid_adapter/multiplier/cell_table.hpp"
#include "fluid_adapter/multiplier/components.hpp"
#include "fluid_adapter/multiplier/layer_cells.hpp"

namespace turbidite {

/// A velocity in the layer below a rank's first and in that above its last, by component.
struct LayersBeside {
    std::array<std::vector<double>, 3> below, above;  ///< nx nz values [m/s]
};

class FluidField {
 public:
    virtual ~FluidField() = default;

    /// The whole grid, over all ranks.
    virtual const CellGrid& grid() const = 0;

    /// Local index of a cell, halo included; -1 if this rank does not know the cell.
    int cell(int i, int j, int k) const {
        const std::array<int, 3>& counts = grid().counts;
        const bool inside =
            i >= 0 && j >= 0 && k >= 0 && i < counts[0] && j < counts[1] && k < counts[2];
        if (!inside) return -1;
        if (grid().dimension == 2) return cells().at(i, j);
        return layers().owns(j) ? layers().cell(i, j, k) : -1;
    }

    /// In space: this rank's cells. They have no halo: points on surfaces, which need one, are of
    /// the plane.
    LayerCells layers() const {
        const int layer = grid().counts[0] * grid().counts[2];
        return {&grid(), first_layer(), owned_cells() / layer};
    }
    virtual int first_layer() const { return 0; }

    /// In the plane: the same lookup without bounds checks, for cells of the grid.
    virtual const CellTable& cells() const = 0;

    virtual int owned_cells() const = 0;  ///< their local indices come first
    virtual int local_cells() const = 0;  ///< owned and halo cells
    bool owns(int cell) const { return cell < owned_cells(); }

    /// rho_f V of the reference cell, whose edges are grid().spacing [kg]; per unit length in two
    /// dimensions.
    virtual double reference_mass() const = 0;

    /// Other ranks have cells that this one knows.
    bool has_halo() const { return local_cells() > owned_cells(); }

    /// rho_f V_c [kg]; per unit length in two dimensions.
    double cell_mass(int i, int j) const { return reference_mass() * grid().relative_volume(i, j); }

    /// One component of velocity, contiguous over the owned cells [m/s].
    virtual double* velocity(int axis) = 0;

    VelocityPointers velocities() {
        VelocityPointers all(grid().dimension);
        for (int axis = 0; axis < all.size(); ++axis) all[axis] = velocity(axis);
        return all;
    }

    /// Whether other ranks know the cell too: it is in this rank's halo or in another's.
    virtual bool shares(int) const { return false; }

    /// Both components of a velocity in the halo cells, in the order of their local indices, as
    /// their owners have them in x and y, over the owned cells; by every rank.
    virtual std::array<const double*, 2> import_halo(const double*, const double*) { return {}; }

    /// In space: what other ranks have beside this rank's layers, of a velocity over the owned
    /// cells; left as it is where there is a side. By every rank.
    virtual void import_layers(const VelocityPointers&, LayersBeside&) const {}

    /// Sums, over all ranks that know a cell, the values they hold there, and returns the sum to
    /// each of them. Both components are indexed by local cell, and zero where the rank contributes
    /// nothing.
    virtual void share_sums(double*, double*) const {}

    /// Sums over the ranks of the fluid, in place.
    virtual void sum_over_ranks(double*, int) const {}

    /// Announces the grains this rank holds. Called by every rank, before the first
    /// sum_over_holders.
    virtual void hold_grains(const GrainId*, int) const {}

    /// Sums data of grains held by more than one rank, in place: so many numbers for each grain of
    /// `hold_grains`, in its order. The result is bitwise the same on every holder.
    virtual void sum_over_holders(double*, int) const {}
};

}  // namespace turbidite
