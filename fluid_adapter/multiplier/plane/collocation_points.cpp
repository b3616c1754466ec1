// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/plane/collocation_points.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "fluid_adapter/multiplier/memory_prefetch.hpp"
#include "fluid_adapter/multiplier/neighbours.hpp"

namespace turbidite {
namespace {

/// At most: quadratic along both axes.
constexpr std::size_t cells_of_stencil = 9;

/// Weights of the nodes of one axis.
struct AxisStencil {
    std::array<int, 3> layer{};
    std::array<double, 3> weight{};
    int nodes = 0;
};

/// The first node of the outward stencil: the last cell centre at or behind the coordinate, seen
/// along `out`.
int node_behind(const CellGrid& grid, int axis, double coordinate, int out) {
    if (grid.stretched(axis)) {
        const int below = grid.layer_below(axis, coordinate);
        // A coordinate at a centre has that node behind it both ways, as with floor and ceil.
        return out > 0 || grid.centre(axis, below) == coordinate ? below : below + 1;
    }
    // In cells from the centre of layer 0.
    const double place = (coordinate - grid.origin[axis]) / grid.spacing[axis] - 0.5;
    return static_cast<int>(out > 0 ? std::floor(place) : std::ceil(place));
}

/// Lagrange weights of three cell centres: w_n = prod_{m != n} (x - x_m)/(x_n - x_m).
std::array<double, 3> lagrange(const CellGrid& grid, int axis, double x,
                               const std::array<int, 3>& layer) {
    std::array<double, 3> node{}, weight{1.0, 1.0, 1.0};
    for (int n = 0; n < 3; ++n) node[n] = grid.centre(axis, layer[n]);
    for (int n = 0; n < 3; ++n)
        for (int m = 0; m < 3; ++m)
            if (m != n) weight[n] *= (x - node[m]) / (node[n] - node[m]);
    return weight;
}

/// Whether all layers of a stencil lie in the grid.
bool fits(const CellGrid& grid, int axis, const AxisStencil& stencil) {
    for (int n = 0; n < stencil.nodes; ++n)
        if (grid.wrapped(axis, stencil.layer[n]) < 0) return false;
    return true;
}

/// Quadratic interpolation from the last centre at or behind the point and the two ahead of it,
/// along the outward direction. The point always lies between the first two nodes, so nothing is
/// extrapolated. A normal component that is zero to rounding counts as positive. Returns no nodes
/// if they leave the grid.
AxisStencil quadratic_outward(const CellGrid& grid, int axis, double coordinate, double normal) {
    const int out = normal < -1e-9 ? -1 : 1;
    const int inner = node_behind(grid, axis, coordinate, out);
    AxisStencil stencil{{inner, inner + out, inner + 2 * out}, {}, 3};
    if (!fits(grid, axis, stencil)) return {};
    if (grid.stretched(axis)) {
        stencil.weight = lagrange(grid, axis, coordinate, stencil.layer);
        return stencil;
    }
    const double place = (coordinate - grid.origin[axis]) / grid.spacing[axis] - 0.5;
    // From the inner node along `out`, in cells: 0 <= t < 1; Lagrange weights of 0, 1 and 2.
    const double t = (place - inner) * out;
    stencil.weight = {0.5 * (1.0 - t) * (2.0 - t), t * (2.0 - t), -0.5 * t * (1.0 - t)};
    return stencil;
}

/// Linear interpolation between the two centres around the point. Returns no nodes if they leave
/// the grid.
AxisStencil linear(const CellGrid& grid, int axis, double coordinate) {
    const int lower = grid.layer_below(axis, coordinate);
    AxisStencil stencil{{lower, lower + 1, 0}, {}, 2};
    if (!fits(grid, axis, stencil)) return {};
    // In cells from the centre of `lower`.
    double t = (coordinate - grid.origin[axis]) / grid.spacing[axis] - 0.5 - lower;
    if (grid.stretched(axis)) {
        const double below = grid.centre(axis, lower), above = grid.centre(axis, lower + 1);
        t = (coordinate - below) / (above - below);
    }
    stencil.weight = {1.0 - t, t, 0.0};
    return stencil;
}

using PlaneStencil = std::array<AxisStencil, 2>;

/// Quadratic along both axes if that fits, else linear, else no nodes.
PlaneStencil plane_stencil(const CellGrid& grid, const Eigen::Vector3d& x,
                           const Eigen::Vector3d& normal) {
    PlaneStencil along;
    for (int axis = 0; axis < 2; ++axis)
        along[axis] = quadratic_outward(grid, axis, x[axis], normal[axis]);
    if (along[0].nodes > 0 && along[1].nodes > 0) return along;
    for (int axis = 0; axis < 2; ++axis) along[axis] = linear(grid, axis, x[axis]);
    if (along[0].nodes > 0 && along[1].nodes > 0) return along;
    return {};
}

/// Size of the cell at a coordinate [m]; outside the grid that of the nearest cell.
double size_at(const CellGrid& grid, int axis, double x) {
    if (!grid.stretched(axis)) return grid.spacing[axis];
    const int layer = grid.layer(axis, x);
    return grid.size(axis, grid.cyclic(axis) ? layer : std::clamp(layer, 0, grid.counts[axis] - 1));
}

/// The longest edge of the cells that a point may be interpolated from, two cells to each side: its
/// wall and its grain may reach rows that are much higher [m].
double stencil_size(const CellGrid& grid, const Eigen::Vector3d& x) {
    return grid.largest_size(x, 2.0 * grid.largest_size(x, 0.0));
}

/// The layers of an axis that a grain reaches.
struct Layers {
    int low, high;
};

Layers layers_of(const CellGrid& grid, int axis, const ImmersedGrain& grain) {
    const Eigen::Vector3d up = grain.orientation.row(axis).transpose();  // the axis, body frame
    return {grid.layer(axis, grain.position[axis] - grain.shape->extent(-up, grain.radius)),
            grid.layer(axis, grain.position[axis] + grain.shape->extent(up, grain.radius))};
}

/// Whether the grain contains a position relative to its centre. Inside the core radius the shape
/// is not queried.
class Inside {
 public:
    explicit Inside(const ImmersedGrain& grain)
        : grain_(grain), to_body_(grain.orientation.transpose()) {
        // A little less than the core, so that rounding does not take in what `contains` refuses.
        constexpr double surely = 1.0 - 1e-9;
        const double core = surely * grain.shape->core_radius(grain.radius);
        core_squared_ = core * core;
    }
    bool operator()(double arm_x, double arm_y) const {
        if (arm_x * arm_x + arm_y * arm_y < core_squared_) return true;
        return grain_.shape->contains(to_body_ * Eigen::Vector3d(arm_x, arm_y, 0.0), grain_.radius);
    }

 private:
    const ImmersedGrain& grain_;
    Eigen::Matrix3d to_body_;
    double core_squared_;
};

/// How far the next image is along a cyclic axis, for a body that reaches around it, whose layers
/// are then cut to one turn; 0 for all others [m].
double cut_to_a_turn(const CellGrid& grid, int axis, Layers& layers) {
    if (!grid.cyclic(axis) || layers.high - layers.low < grid.counts[axis]) return 0.0;
    // Otherwise its first and last layers would be the same cells, visited twice.
    layers.high = layers.low + grid.counts[axis] - 1;
    return grid.length(axis);
}

/// Calls visit(point) for the cells known to this rank whose centre the grain contains.
template <class Visit>
void for_cells_inside(const FluidField& field, const ImmersedGrain& grain, Visit visit) {
    const CellGrid& grid = field.grid();
    const CellTable& cells = field.cells();
    Layers across = layers_of(grid, 0, grain), up = layers_of(grid, 1, grain);
    const double around = cut_to_a_turn(grid, 0, across), over = cut_to_a_turn(grid, 1, up);
    const Inside body(grain);
    // Leaves the arm at the image that is inside.
    const auto inside = [&](double& x, double& y) {
        if (body(x, y)) return true;
        if (around > 0.0 && body(x + around, y)) return x += around, true;
        if (over > 0.0 && body(x, y + over)) return y += over, true;
        return false;
    };
    for (int j = up.low; j <= up.high; ++j) {
        const int row = grid.wrapped(1, j);
        if (row < 0) continue;
        const double above = grid.centre(1, j) - grain.position.y();
        for (int i = across.low; i <= across.high; ++i) {
            double arm_x = grid.centre(0, i) - grain.position.x(), arm_y = above;
            if (!inside(arm_x, arm_y)) continue;
            const int column = grid.wrapped(0, i);
            if (column < 0) continue;
            const int cell = cells.at(column, row);
            if (cell >= 0)
                visit(InteriorCell{cell, arm_x, arm_y, grid.relative_volume(column, row)});
        }
    }
}

double relative_depth(const ImmersedGrain& grain, const InteriorCell& point) {
    return (point.arm_x * point.arm_x + point.arm_y * point.arm_y) / (grain.radius * grain.radius);
}

/// Calls visit(x) for the images x of `apart`, which is the nearest one, up to a distance `outer`;
/// for that itself in any case.
template <class Visit>
void for_images(const CellGrid& grid, const Eigen::Vector3d& apart, double outer,
                const Visit& visit) {
    const auto most = [&](int axis) {
        // `apart` is at most L/2 away: image i is at least (|i| - 1/2) L away, and out of reach
        // where that exceeds `outer`.
        return grid.cyclic(axis) ? static_cast<int>(outer / grid.length(axis) + 0.5) : 0;
    };
    for (int i = -most(0); i <= most(0); ++i)
        for (int j = -most(1); j <= most(1); ++j) {
            const Eigen::Vector3d image =
                apart + Eigen::Vector3d(i * grid.length(0), j * grid.length(1), 0.0);
            if ((i == 0 && j == 0) || image.norm() <= outer) visit(image);
        }
}

}  // namespace

void PointPlacement::place(const FluidField& field, const std::vector<ImmersedGrain>& grains,
                           CollocationPoints& points) {
    if (field.grid().dimension != 2)
        throw std::invalid_argument("multiplier points are supported in two dimensions only");
    // Set to -1 once; `forget` undoes what a window sets, so that none passes over all cells.
    owner_.resize(field.local_cells(), -1);
    depth_.resize(field.local_cells());
    slot_.resize(field.local_cells(), -1);

    find_candidates(field, grains);
    // Rule 1 for the sides of the box
    apply_wall_rule(field.grid(), grains);
    find_pairs(field.grid(), grains);
    // Rule 1 for bodies without boundary points, and rules 2 and 3. `compare` drops points of its
    // first grain only: the two calls make rule 3 drop both points.
    for (const auto& [a, b] : pairs_) {
        compare(field.grid(), grains, a, b);
        compare(field.grid(), grains, b, a);
    }
    for (int g = 0; g < static_cast<int>(grains.size()); ++g)
        if (meets_itself(field.grid(), grains[g], local_size_[g]))
            compare(field.grid(), grains, g, g);
    // Rule 4. It also sets slot_ of the cells in use, by which collect_interior knows rule 6.
    collect_boundary(field, grains, points);
    // Rule 5
    claim_cells(field, grains);
    collect_interior(field, grains, points);
    count_dropped(points);
    forget(points);
}

void PointPlacement::find_candidates(const FluidField& field,
                                     const std::vector<ImmersedGrain>& grains) {
    candidates_.clear();
    first_.assign(1, 0);
    local_size_.clear();
    for (const ImmersedGrain& grain : grains) {
        // Where rows grow the spacing is that of the longest edge: points closer than a cell to
        // each other would make the problem ill-conditioned.
        local_size_.push_back(field.grid().largest_size(grain.position, grain.radius));
        if (rules_.boundary && grain.has_boundary_points)
            for (const SurfacePoint& point :
                 surface_points(grain, rules_.spacing * local_size_.back())) {
                Candidate candidate;
                candidate.arm = grain.orientation * point.position;
                candidate.normal = grain.orientation * point.normal;
                candidates_.push_back(candidate);
            }
        first_.push_back(static_cast<int>(candidates_.size()));
    }
}

const std::vector<SurfacePoint>& PointPlacement::surface_points(const ImmersedGrain& grain,
                                                                double spacing) {
    std::vector<SurfacePoint>& ring = rings_[{grain.shape, grain.radius, spacing}];
    if (ring.empty()) ring = grain.shape->surface_points(grain.radius, spacing);
    return ring;
}

void PointPlacement::apply_wall_rule(const CellGrid& grid,
                                     const std::vector<ImmersedGrain>& grains) {
    for (std::size_t g = 0; g < grains.size(); ++g)
        for (int c = first_[g]; c < first_[g + 1]; ++c)
            for (int axis = 0; axis < grid.dimension; ++axis) {
                const double x = grains[g].position[axis] + candidates_[c].arm[axis];
                const double from_lower = x - grid.origin[axis];
                const double from_upper = grid.length(axis) - from_lower;
                // Open and cyclic sides drop no points.
                const double least = rules_.wall_distance * size_at(grid, axis, x);
                if ((grid.sides[axis][0] == Side::wall && from_lower < least) ||
                    (grid.sides[axis][1] == Side::wall && from_upper < least))
                    candidates_[c].fate = Fate::near_wall;
            }
}

void PointPlacement::find_pairs(const CellGrid& grid, const std::vector<ImmersedGrain>& grains) {
    const double largest =
        local_size_.empty() ? 0.0 : *std::max_element(local_size_.begin(), local_size_.end());
    const bool walls = std::any_of(grains.begin(), grains.end(), [](const ImmersedGrain& grain) {
        return !grain.has_boundary_points;
    });
    const double reach = walls ? std::max(rules_.spacing, rules_.wall_distance) : rules_.spacing;
    pairs_ = near_pairs(grid, grains, rules_.boundary ? reach * largest : 0.0);
    // Only grains that overlap can contain the same cells: rule 5 need not look at the others.
    overlapped_.assign(grains.size(), 0);
    for (const auto& [a, b] : pairs_) {
        const double apart = grid.nearest_image(grains[a].position - grains[b].position).norm();
        const double touching = (1.0 + 1e-9) * (grains[a].radius + grains[b].radius);
        if (apart < touching) overlapped_[a] = overlapped_[b] = 1;
    }
}

/// Whether points of the grain may be too near to those of its own image.
bool PointPlacement::meets_itself(const CellGrid& grid, const ImmersedGrain& grain,
                                  double size) const {
    const double least = 2.0 * grain.radius + rules_.spacing * size;
    return rules_.boundary && grain.has_boundary_points &&
           ((grid.cyclic(0) && grid.length(0) < least) ||
            (grid.cyclic(1) && grid.length(1) < least));
}

/// Rule 1 for the points of grain a and all images of wall b: of a wall that is longer than half a
/// period the one with the nearest middle need not be the nearest.
void PointPlacement::keep_off_wall(const CellGrid& grid, const std::vector<ImmersedGrain>& grains,
                                   int a, int b, const Eigen::Vector3d& apart) {
    const ImmersedGrain &grain = grains[a], &wall = grains[b];
    const double outer = grain.radius + wall.radius +
                         rules_.wall_distance * std::max(local_size_[a], local_size_[b]);
    const Eigen::Matrix3d to_body = wall.orientation.transpose();
    for_images(grid, apart, outer, [&](const Eigen::Vector3d& from_image) {
        for (int c = first_[a]; c < first_[a + 1]; ++c) {
            Candidate& candidate = candidates_[c];
            if (candidate.fate == Fate::near_wall) continue;
            const double size = stencil_size(grid, grain.position + candidate.arm);
            if (wall.shape->least_distance(to_body * (from_image + candidate.arm), wall.radius) <=
                rules_.wall_distance * size)
                candidate.fate = Fate::near_wall;
        }
    });
}

void PointPlacement::compare(const CellGrid& grid, const std::vector<ImmersedGrain>& grains, int a,
                             int b) {
    const Eigen::Vector3d apart = grid.nearest_image(grains[a].position - grains[b].position);
    if (!grains[b].has_boundary_points) return keep_off_wall(grid, grains, a, b, apart);
    const double reach = rules_.spacing * std::max(local_size_[a], local_size_[b]);
    const double outer = grains[b].radius + reach;
    // Also the second nearest image: across a short period two grains touch on both sides, and a
    // grain may touch itself.
    for_images(grid, apart, grains[a].radius + outer, [&](const Eigen::Vector3d& from_image) {
        if (a != b || from_image != apart) compare_image(grains, a, b, from_image, reach);
    });
}

/// `apart`: from an image of grain b to grain a.
void PointPlacement::compare_image(const std::vector<ImmersedGrain>& grains, int a, int b,
                                   const Eigen::Vector3d& apart, double reach) {
    const double outer = grains[b].radius + reach;
    const Eigen::Matrix3d to_body = grains[b].orientation.transpose();
    for (int c = first_[a]; c < first_[a + 1]; ++c) {
        Candidate& candidate = candidates_[c];
        const Eigen::Vector3d from_b = apart + candidate.arm;
        // Rule 1 comes first, for the counts too.
        if (candidate.fate == Fate::near_wall || from_b.squaredNorm() > outer * outer) continue;
        const Eigen::Vector3d in_b = to_body * from_b;
        // Points of b lie on its surface: farther from b than `reach`, none of them can be near.
        if (grains[b].shape->least_distance(in_b, grains[b].radius) > reach) continue;
        if (grains[b].shape->contains(in_b, grains[b].radius)) candidate.fate = Fate::inside_grain;
        if (candidate.fate == Fate::inside_grain) continue;
        // All points of b, dropped ones too: otherwise the order of the pairs would matter.
        for (int other = first_[b]; other < first_[b + 1]; ++other)
            if ((from_b - candidates_[other].arm).squaredNorm() < reach * reach)
                candidate.fate = Fate::near_point;
    }
}

StencilBox box_of(const AxisStencil& along_x, const AxisStencil& along_y) {
    const auto ends = [](const AxisStencil& along) {
        return std::minmax_element(along.layer.begin(), along.layer.begin() + along.nodes);
    };
    const auto x = ends(along_x), y = ends(along_y);
    return {*x.first, *x.second, *y.first, *y.second};
}

void PointPlacement::collect_boundary(const FluidField& field,
                                      const std::vector<ImmersedGrain>& grains,
                                      CollocationPoints& points) {
    points.boundary_begin.assign(1, 0);
    points.arm_x.clear();
    points.arm_y.clear();
    points.box.clear();
    points.stencil.assign(1, 0);
    // At most; cut to what is used at the end.
    points.slot.resize(cells_of_stencil * candidates_.size());
    points.weight.resize(points.slot.size());
    points.stencilled.clear();
    for (std::size_t g = 0; g < grains.size(); ++g) {
        if (g + 1 < grains.size()) expect(field, grains[g + 1]);
        collect_ring(field, grains[g], static_cast<int>(g), points);
        points.boundary_begin.push_back(points.boundary_points());
    }
    points.slot.resize(points.stencil.back());
    points.weight.resize(points.stencil.back());
}

/// 0, n-1, 1, n-2, ...: the ring folded flat.
void PointPlacement::collect_ring(const FluidField& field, const ImmersedGrain& grain, int g,
                                  CollocationPoints& points) {
    ring_.clear();
    for (int c = first_[g]; c < first_[g + 1]; ++c)
        if (candidates_[c].fate == Fate::kept) ring_.push_back(c);
    std::size_t low = 0, high = ring_.size();
    while (low < high) {
        collect(field, grain, candidates_[ring_[low++]], points);
        if (low < high) collect(field, grain, candidates_[ring_[--high]], points);
    }
}

/// Asks for the slots around a grain, which lie far apart in memory, before they are needed.
void PointPlacement::expect(const FluidField& field, const ImmersedGrain& grain) const {
    constexpr int in_a_line = 64 / sizeof(int);
    const CellGrid& grid = field.grid();
    const Layers across = layers_of(grid, 0, grain), up = layers_of(grid, 1, grain);
    for (int j = up.low - 2; j <= up.high + 2; ++j)
        for (int i = across.low - 2; i <= across.high + 2 + in_a_line; i += in_a_line) {
            const int column = grid.wrapped(0, i), row = grid.wrapped(1, j);
            const int cell = column < 0 || row < 0 ? -1 : field.cells().at(column, row);
            if (cell >= 0) ask_for(&slot_[cell]);
        }
}

/// Appends a boundary point with the tensor product of both axes' stencils. A point of another rank
/// only reserves the slots.
void PointPlacement::collect(const FluidField& field, const ImmersedGrain& grain,
                             Candidate& candidate, CollocationPoints& points) {
    const CellGrid& grid = field.grid();
    const CellTable& cells = field.cells();
    const Eigen::Vector3d x = grain.position + candidate.arm;
    const PlaneStencil along = plane_stencil(grid, x, candidate.normal);
    if (along[0].nodes == 0) {
        candidate.fate = Fate::off_grid;
        return;
    }
    // The rank that owns the cell around the point has the point.
    const int home =
        field.cell(grid.wrapped(0, grid.layer(0, x[0])), grid.wrapped(1, grid.layer(1, x[1])), 0);
    const bool owned = home >= 0 && field.owns(home);
    int next = points.stencil.back();
    for (int n = 0; n < along[1].nodes; ++n) {
        const int row = grid.wrapped(1, along[1].layer[n]);
        for (int m = 0; m < along[0].nodes; ++m) {
            const double weight = along[0].weight[m] * along[1].weight[n];
            // A point on a line of centres leaves the cells beside it to the interior (rule 6).
            if (std::abs(weight) < on_the_edge) continue;  // 0 but for rounding, in any units
            const int column = grid.wrapped(0, along[0].layer[m]);
            const int cell = cells.at(column, row);
            if (cell < 0) continue;  // beyond the halo: of another rank's point
            int slot = slot_[cell];
            // Also for a point of another rank: rule 6 is about points of all ranks.
            if (slot < 0) slot = new_slot(cell, grid.relative_volume(column, row), points);
            if (!owned) continue;
            points.slot[next] = slot;
            points.weight[next++] = weight;
        }
    }
    if (!owned) return;
    points.arm_x.push_back(candidate.arm.x());
    points.arm_y.push_back(candidate.arm.y());
    points.box.push_back(box_of(along[0], along[1]));
    points.stencil.push_back(next);
}

int PointPlacement::new_slot(int cell, double volume, CollocationPoints& points) {
    slot_[cell] = points.slots();
    points.stencilled.push_back({cell, volume});
    return slot_[cell];
}

/// Rule 5, for the grains it can concern.
void PointPlacement::claim_cells(const FluidField& field,
                                 const std::vector<ImmersedGrain>& grains) {
    claimed_.clear();
    for (std::size_t g = 0; g < grains.size(); ++g) {
        if (!overlapped_[g]) continue;
        for_cells_inside(field, grains[g], [&](const InteriorCell& point) {
            const double depth = relative_depth(grains[g], point);
            // Smaller is deeper: |r|^2/R_h^2 is 0 in the middle and 1 on a disc's surface.
            const int rival = owner_[point.cell];
            if (rival >= 0 && (depth > depth_[point.cell] ||
                               (depth == depth_[point.cell] && grains[g].id > grains[rival].id)))
                return;
            owner_[point.cell] = static_cast<int>(g);
            depth_[point.cell] = depth;
            claimed_.push_back(point.cell);
        });
    }
}

void PointPlacement::collect_interior(const FluidField& field,
                                      const std::vector<ImmersedGrain>& grains,
                                      CollocationPoints& points) const {
    points.interior_begin.assign(1, 0);
    points.interior.clear();
    const int owned = field.owned_cells();
    for (std::size_t g = 0; g < grains.size(); ++g) {
        if (g + 1 < grains.size()) expect(field, grains[g + 1]);
        for_cells_inside(field, grains[g], [&](const InteriorCell& point) {
            const bool mine = !overlapped_[g] || owner_[point.cell] == static_cast<int>(g);
            // Rule 5, rule 6, and the rank's own: owned cells have the first local indices.
            if (mine && slot_[point.cell] < 0 && point.cell < owned)
                points.interior.push_back(point);
        });
        points.interior_begin.push_back(static_cast<int>(points.interior.size()));
    }
}

void PointPlacement::count_dropped(CollocationPoints& points) const {
    points.dropped = {};
    for (const Candidate& point : candidates_) {
        points.dropped.near_wall += point.fate == Fate::near_wall;
        points.dropped.inside_grain += point.fate == Fate::inside_grain;
        points.dropped.near_point += point.fate == Fate::near_point;
        points.dropped.off_grid += point.fate == Fate::off_grid;
    }
}

void PointPlacement::forget(const CollocationPoints& points) {
    for (const StencilCell& at : points.stencilled) slot_[at.cell] = -1;
    for (const int cell : claimed_) owner_[cell] = -1;
}

}  // namespace turbidite
