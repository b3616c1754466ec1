// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The collocation points of the constraint: where the fluid must move with the grain (Topin 2011,
// Eq. 10), on the disc of radius R_h. There are two kinds:
//
//   interior   a cell centre inside the grain; u there is the cell's velocity
//   boundary   a point on the surface; u there is interpolated from 3 x 3 cells that extend out
//              into the fluid (quadratic, selected by the outward normal), or from 2 x 2 cells
//              where those leave the grid
//
// Outward interpolation constrains fluid beyond the surface, so that the drag is that of a grain
// larger by about a tenth of a cell: for a square array (Sangani & Acrivos 1982, area fraction 0.2,
// D/16) it came out 4.0 % high (docs/validation.md). `fluid.hydrodynamic_radius` can
// calibrate this.
//
// The rules, in this order. Rules 1-3 are applied to all candidates, not to those that survive an
// earlier rule, so that the result does not depend on the numbering of the grains. Lengths in cells
// refer to the longest edge of the cells around a grain, in rule 1 to that of the cell at the point
// for a side of the box, and of those within two cells of the point for a body.
//
//   1. A boundary point closer than 2 cells to a wall, or to a body that has interior points only,
//      is dropped.
//   2. A boundary point inside another grain is dropped.
//   3. Two boundary points of different grains closer than the point spacing are both dropped. In 2
//      and 3 every image across a cyclic side counts as another grain, also of the grain itself.
//   4. A boundary point whose 2 x 2 cells leave the grid is dropped.
//   5. A cell centre inside several grains belongs to the one in which it lies deepest (smallest
//      distance from the centre over R_h; the smaller id if equal).
//   6. A cell used by a remaining boundary point, of any grain, is not an interior point.
//
// With several ranks, each rank considers all grains it holds and keeps the points that lie in
// cells it owns. Valid C++17.
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
    double spacing = 1.5;        ///< of boundary points, also the distance of rule 3 [cells]
    double wall_distance = 2.0;  ///< distance of rule 1 [cells]
};

/// Number of boundary points dropped by each rule.
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
    double volume;        ///< V_c over that of the reference cell
};

/// A cell used for interpolation by boundary points.
struct StencilCell {
    int cell;       ///< local index
    double volume;  ///< V_c over that of the reference cell
};

/// The layers of the grid covered by a stencil; indices are not wrapped.
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
/// interpolate from, so that what belongs to these cells lies close together. Boundary points go
/// round the grain from both ends of its ring alternately, so that neighbours on the ring are near
/// each other in the list, all round. In-place: a window reuses the last one's memory.
struct CollocationPoints {
    std::vector<int> interior_begin;
    std::vector<InteriorCell> interior;
    std::vector<int> boundary_begin;
    std::vector<double> arm_x, arm_y;  ///< r = x - X [m]
    std::vector<StencilBox> box;
    std::vector<int> stencil;
    std::vector<int> slot;
    std::vector<double> weight;
    std::vector<StencilCell> stencilled;  ///< by slot; includes cells used by other ranks' points
    DroppedPoints dropped;

    int grains() const { return static_cast<int>(boundary_begin.size()) - 1; }
    int boundary_points() const { return static_cast<int>(arm_x.size()); }
    int size() const { return static_cast<int>(interior.size()) + boundary_points(); }
    int slots() const { return static_cast<int>(stencilled.size()); }

    /// Local index of the cell of weight s.
    int cell(int s) const { return stencilled[slot[s]].cell; }
};

/// Places the points of all grains by the rules above.
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
    void compare_image(const std::vector<ImmersedGrain>& grains, int a, int b,
                       const Eigen::Vector3d& apart, double reach);
    bool meets_itself(const CellGrid& grid, const ImmersedGrain& grain, double size) const;
    void keep_off_wall(const CellGrid& grid, const std::vector<ImmersedGrain>& grains, int a, int b,
                       const Eigen::Vector3d& apart);
    void collect_boundary(const FluidField& field, const std::vector<ImmersedGrain>& grains,
                          CollocationPoints& points);
    void collect_ring(const FluidField& field, const ImmersedGrain& grain, int g,
                      CollocationPoints& points);
    void collect(const FluidField& field, const ImmersedGrain& grain, Candidate& candidate,
                 CollocationPoints& points);
    int new_slot(int cell, double volume, CollocationPoints& points);
    void expect(const FluidField& field, const ImmersedGrain& grain) const;
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
    std::vector<int> ring_;                   // candidates of one grain that are left
    std::vector<std::pair<int, int>> pairs_;  // of grains whose points may be too close
    std::vector<char> overlapped_;            // by grain: another grain may contain the same cells
    std::vector<int> claimed_;                // cells inside overlapped grains
    // By local cell; reset to "not claimed" between calls.
    std::vector<int> owner_;     // grain that claims the cell, -1 none
    std::vector<double> depth_;  // squared distance from its centre over R_h
    std::vector<int> slot_;      // of a cell used for interpolation, -1 none
    // Surface points by shape, radius and spacing, computed once.
    std::map<std::tuple<const Shape*, double, double>, std::vector<SurfacePoint>> rings_;
};

}  // namespace turbidite
