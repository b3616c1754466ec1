// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Which cells move with which sphere, or wall inside the box. A cell belongs to the sphere of R_h
// that its centre lies in; of several, to that with the smallest power |r|^2 - R_h^2, so that a
// plane divides two spheres that overlap (the smaller id where it is equal, to rounding either).
// Cells of walls (wall_cells.hpp) are no sphere's. A cell of none whose six neighbours are covered,
// or beyond a side, joins that of the spheres around it which has the smallest power, or a wall
// where there are walls only: its pressure would be tied to no other. Valid C++17.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "fluid_adapter/multiplier/immersed_grain.hpp"
#include "fluid_adapter/multiplier/space/cell_owners.hpp"
#include "fluid_adapter/multiplier/space/wall_cells.hpp"
#include "fluid_adapter/multiplier/space/wedges.hpp"

namespace turbidite {

/// Consecutive cells along x that belong to a sphere.
struct CellRun {
    int cell;  ///< local index of the first
    int count;
    Eigen::Vector3d first;  ///< r = x - X of its centre [m]
    double volume;          ///< V_c over that of the reference cell
};

class SphereCells {
 public:
    /// Keeps a reference to the grid.
    explicit SphereCells(const LayerCells& cells)
        : cells_(cells), owners_(cells), walls_(cells_, owners_), wedges_(cells_, owners_) {}
    SphereCells(const SphereCells&) = delete;  // walls and wedges refer to the cells
    SphereCells& operator=(const SphereCells&) = delete;

    /// Finds the cells of this rank. Every rank passes all spheres within three cells of its
    /// layers, and all walls.
    void find(const std::vector<ImmersedGrain>& grains);

    const CellOwners& owners() const { return owners_; }
    const std::vector<CellRun>& runs(std::size_t grain) const { return runs_[grain]; }

    /// Cells that joined a sphere since they were shut in.
    int shut_in() const { return shut_in_; }

    /// Of this rank's cells. Not found with them, since the paper's splitting has no use for them.
    const Wedges& find_wedges();

 private:
    struct Row {
        int grain, j, k;
        double dy, dz;  // of its cells' centres from the grain's [m]
    };
    struct CellOfGrain {
        int grain;
        CellPlace at;
        Eigen::Vector3d arm;  // along the run, which of a wall may be longer than half a period
    };

    void find_neighbours(const std::vector<ImmersedGrain>& grains);
    int owner_of_wall(int wall) const;
    void find_wall(int wall);
    void find_runs(int grain);
    void find_row(const Row& row);
    bool belongs(int grain, int i, int j, int k) const;
    double power(int grain, int i, int j, int k) const;
    double arm(int grain, int axis, int wrapped) const;
    void add_run(const Row& row, int low, int high);
    void add_cells(int body, int owner, const CellPlace& first, int count,
                   const Eigen::Vector3d& arm);
    void join_shut_in();
    bool is_shut_in(const CellPlace& at) const;
    int nearest(const CellOfGrain& of) const;
    CellPlace place_of(int cell) const;
    const CellGrid& grid() const { return *cells_.grid; }

    LayerCells cells_;
    const std::vector<ImmersedGrain>* grains_ = nullptr;
    std::vector<std::uint8_t> prescribed_;      // by grain
    std::vector<std::vector<int>> neighbours_;  // by grain: near ones
    std::vector<std::vector<CellRun>> runs_;    // by grain
    CellOwners owners_;
    WallCells walls_;
    Wedges wedges_;
    std::vector<CellOfGrain> beside_runs_;  // the cell before or after a run, in any known layer
    int shut_in_ = 0;
};

}  // namespace turbidite
