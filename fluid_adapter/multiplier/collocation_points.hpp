// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The points at which the fluid must move with the grain (Topin 2011, Eq. 10), on the disc of
// radius R_h. Two kinds:
//
//   interior   a cell centre inside the grain: u there is the cell's velocity
//   boundary   a point of the surface: u there is interpolated from 3 x 3 cells which reach out
//              into the fluid (quadratic, chosen by the outward normal), or from 2 x 2 where those
//              leave the grid
//
// Interpolation that reaches outwards ties fluid beyond the surface and makes the grain look larger
// by about a tenth of a cell to the drag: a square array (Sangani & Acrivos 1982, area fraction
// 0.2, D/16) came out 5 % high, as published for such points. `fluid.hydrodynamic_radius` can
// calibrate it.
//
// Rules, in this order. Rules 1-3 look at all candidates and not at survivors, so that the outcome
// does not depend on how the grains are numbered.
//
// Lengths counted in cells are those of the longest edges of the cells around a grain; rule 1
// counts the cells at the point itself.
//
//   1. A boundary point nearer than 2 cells to a wall is dropped.
//   2. A boundary point inside another grain is dropped.
//   3. Two boundary points of different grains nearer than the point spacing are both dropped.
//   4. A boundary point whose 2 x 2 cells leave the grid is dropped.
//   5. A cell centre inside several grains belongs to the one in which it lies deepest (smallest
//      distance from the centre over R_h; the smaller id if equal).
//   6. A cell used by a boundary point that is left, of whatever grain, is no interior point.
//
// With several ranks each looks at all grains it holds and keeps the points in cells it owns.
// Valid C++17.
#pragma once

#include <array>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "fluid_adapter/multiplier/fluid_field.hpp"
#include "fluid_adapter/multiplier/immersed_grain.hpp"

namespace turbidite {

struct PointRules {
    bool boundary = true;        ///< place boundary points at all
    double spacing = 1.5;        ///< between boundary points, and rule 3 [cells]
    double wall_distance = 2.0;  ///< rule 1 [cells]
};

/// How many boundary points each rule took.
struct DroppedPoints {
    int near_wall = 0;
    int inside_grain = 0;
    int near_point = 0;
    int off_grid = 0;
};

/// An interior point: a cell that moves with the grain.
struct InteriorCell {
    int cell;             ///< local index
    double arm_x, arm_y;  ///< r = x - X [m]
    double volume;        ///< V_c over the grid's reference cell
};

/// A cell that boundary points interpolate from.
struct StencilCell {
    int cell;       ///< local index
    double volume;  ///< V_c over the grid's reference cell
};

/// The layers of a grid that a stencil covers, not wrapped.
struct StencilBox {
    int low_x, high_x, low_y, high_y;

    bool meets(const StencilBox& other) const {
        return low_x <= other.high_x && other.low_x <= high_x && low_y <= other.high_y &&
               other.low_y <= high_y;
    }
};

/// Interior points of grain g are interior_begin[g] .. interior_begin[g+1]-1 of `interior`,
/// boundary points boundary_begin[g] .. boundary_begin[g+1]-1 of `arm`. The cells of boundary point
/// p are stencil[p] .. stencil[p+1]-1 of `slot` and `weight`; slots number the cells that points
/// interpolate from, so that what belongs to these cells lies close together. In-place: a window
/// reuses the last one's memory.
struct CollocationPoints {
    std::vector<int> interior_begin;
    std::vector<InteriorCell> interior;
    std::vector<int> boundary_begin;
    std::vector<double> arm_x, arm_y;  ///< r = x - X [m]
    std::vector<StencilBox> box;
    std::vector<int> stencil;
    std::vector<int> slot;
    std::vector<double> weight;
    std::vector<StencilCell> stencilled;  ///< by slot; of other ranks' points too
    DroppedPoints dropped;

    int grains() const { return static_cast<int>(boundary_begin.size()) - 1; }
    int boundary_points() const { return static_cast<int>(arm_x.size()); }
    int size() const { return static_cast<int>(interior.size()) + boundary_points(); }
    int slots() const { return static_cast<int>(stencilled.size()); }

    /// Local index of the cell of the s-th weight.
    int cell(int s) const { return stencilled[slot[s]].cell; }
};

/// Places the points of all grains.
class PointPlacement {
 public:
    explicit PointPlacement(const PointRules& rules) : rules_(rules) {}

    void place(const FluidField& field, const std::vector<ImmersedGrain>& grains,
               CollocationPoints& points);

 private:
    enum class Fate : char { kept, near_wall, inside_grain, near_point, off_grid };

    struct Candidate {
        Eigen::Vector3d arm;     // from the grain's centre
        Eigen::Vector3d normal;  // outward
        Fate fate = Fate::kept;
    };

    void find_candidates(const FluidField& field, const std::vector<ImmersedGrain>& grains);
    void find_pairs(const CellGrid& grid, const std::vector<ImmersedGrain>& grains);
    void apply_wall_rule(const CellGrid& grid, const std::vector<ImmersedGrain>& grains);
    void compare(const CellGrid& grid, const std::vector<ImmersedGrain>& grains, int a, int b);
    void collect_boundary(const FluidField& field, const std::vector<ImmersedGrain>& grains,
                          CollocationPoints& points);
    void collect(const FluidField& field, const ImmersedGrain& grain, Candidate& candidate,
                 CollocationPoints& points);
    int slot_of(const FluidField& field, int column, int row, CollocationPoints& points);
    void claim_cells(const FluidField& field, const std::vector<ImmersedGrain>& grains);
    void collect_interior(const FluidField& field, const std::vector<ImmersedGrain>& grains,
                          CollocationPoints& points) const;
    void count_dropped(CollocationPoints& points) const;
    void forget(const CollocationPoints& points);

    const std::vector<SurfacePoint>& surface_points(const ImmersedGrain& grain, double spacing);

    PointRules rules_;
    std::vector<int> first_;          // first candidate of each grain
    std::vector<double> local_size_;  // longest cell edge around each grain [m]
    std::vector<Candidate> candidates_;
    std::vector<std::pair<int, int>> pairs_;  // of grains whose points may be too close
    std::vector<char> overlapped_;            // by grain: another may contain the same cells
    std::vector<int> claimed_;                // cells inside such grains
    // By cell, as between two calls: nothing claimed.
    std::vector<int> owner_;     // grain that claims it, -1 none
    std::vector<double> depth_;  // its squared relative distance
    std::vector<int> slot_;      // in which points interpolate from it, -1 none
    // Of shapes, radii and spacings met so far.
    std::map<std::tuple<const Shape*, double, double>, std::vector<SurfacePoint>> rings_;
};

}  // namespace turbidite
