// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The spin that a sphere takes up by moving through the cells, and gives back. A cell that it newly
// covers brings its slip s = u - U - omega x r into the sphere, though no fluid passes a surface,
// and a cell that it leaves has none. Before, transport has carried the mean of both sides, s/2,
// through the face between them: out of the sphere ahead of it, and into it behind. So the sphere
// has taken s/2 per volume that it has covered, and s/2 per volume that it has left. That goes
// back:
//
//     covered    to the free cells outside, s/2 of the cell, with the moment that these get
//     left       to the cell, s/2 of the free cells outside, with the moment that the cells of the
//                sphere beside it had got
//
// "Outside" are neighbours across faces, each by the component of the normal. The sphere gives the
// moment alone: the momentum is taken off the shell of free cells around it, a cell thick, of each
// by |n.U|, as often as it is crossed, since without it the drag is that of a sphere at rest in a
// stream. Otherwise a sphere that crosses cells sideways takes up a spin, the slip being larger
// ahead than behind. Evidence: docs/decisions/multipliers.md. Valid C++17.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "fluid_adapter/multiplier/fluid_field.hpp"
#include "fluid_adapter/multiplier/space/crossed_cells.hpp"

namespace turbidite {

class SlipReturn {
 public:
    /// Keeps references to both; the owners are those of the window's positions.
    SlipReturn(const FluidField& field, const CellOwners& owners)
        : field_(field), cells_(field.layers()), owners_(owners), crossed_(cells_, owners) {}

    /// Changes u in free cells; returns the moment about its centre that each grain gives, over all
    /// ranks. By every rank.
    std::vector<Eigen::Vector3d> play(const std::vector<ImmersedGrain>& grains,
                                      const VelocityPointers& u);

 private:
    /// Of a grain: what its cells give (linear, angular), and weighted mass and first moment of its
    /// shell.
    using Sums = Eigen::Matrix<double, 10, 1>;

    /// A cell of a grain's shell, on this rank.
    struct ShellCell {
        std::size_t grain;
        int cell;
        double weight;  // |n.U|/|U|
    };

    /// Cells along x within `half` of the centre, in the grid's row (j, k).
    struct ShellRow {
        std::size_t grain;
        int j, k;
        Eigen::Vector3d arm;  // without x
        double half;
        Eigen::Vector3d way;  // U/|U|
    };

    /// A neighbour, and its part of all.
    struct Beside {
        CellPlace at;         // in the grid
        Eigen::Vector3d arm;  // from the grain's centre
        double share;
    };

    void return_from(const CrossedCell& cell, const ImmersedGrain& sphere, Sums& sums);
    void find_shell_row(const ShellRow& row, const ImmersedGrain& sphere, Sums& sums);
    void find_shell(std::size_t grain, const ImmersedGrain& sphere, Sums& sums);
    void find_outside(const CrossedCell& cell, const ImmersedGrain& sphere);
    void find_inside(const CrossedCell& cell);
    template <class Accept>
    void find_beside(const CrossedCell& cell, int direction, Accept accept,
                     std::vector<Beside>& found) const;
    bool owns(const CellPlace& at) const { return cells_.owns(at.j); }
    Eigen::Vector3d velocity(const CellPlace& at) const;
    Eigen::Vector3d slip(const ImmersedGrain& sphere, const CellPlace& at,
                         const Eigen::Vector3d& arm) const;
    Eigen::Vector3d returned(const CrossedCell& cell, const ImmersedGrain& sphere) const;
    Eigen::Vector3d giving_arm(const CrossedCell& cell);
    void give(const CrossedCell& cell, const Eigen::Vector3d& half);
    const CellGrid& grid() const { return *cells_.grid; }

    const FluidField& field_;
    LayerCells cells_;
    const CellOwners& owners_;
    CrossedCells crossed_;
    VelocityPointers u_{3};
    LayersBeside beside_;
    std::vector<Beside> outside_, inside_;  // of one cell
    std::vector<ShellCell> shell_;
    std::vector<std::pair<int, Eigen::Vector3d>> change_;  // of own cells
};

}  // namespace turbidite
