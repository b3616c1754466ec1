// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/collocation_points.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "fluid_adapter/multiplier/neighbours.hpp"

namespace turbidite {
namespace {

/// Weights of the nodes of one axis.
struct AxisStencil {
    std::array<int, 3> layer{};
    std::array<double, 3> weight{};
    int nodes = 0;
};

/// Quadratic through the last centre at or behind the point and the two ahead of it, seen along the
/// outward direction: the point always lies between the first two nodes, so nothing is
/// extrapolated. A normal without component along the axis counts as positive, whatever its
/// rounding.
AxisStencil quadratic_outward(const CellGrid& grid, int axis, double coordinate, double normal) {
    const int out = normal < -1e-9 ? -1 : 1;
    const double place = (coordinate - grid.origin[axis]) / grid.spacing[axis] - 0.5;
    const int inner = static_cast<int>(out > 0 ? std::floor(place) : std::ceil(place));
    const double t = (place - inner) * out;
    return {{inner, inner + out, inner + 2 * out},
            {0.5 * (1.0 - t) * (2.0 - t), t * (2.0 - t), -0.5 * t * (1.0 - t)},
            3};
}

AxisStencil linear(const CellGrid& grid, int axis, double coordinate) {
    const double place = (coordinate - grid.origin[axis]) / grid.spacing[axis] - 0.5;
    const int lower = static_cast<int>(std::floor(place));
    const double t = place - lower;
    return {{lower, lower + 1, 0}, {1.0 - t, t, 0.0}, 2};
}

bool fits(const CellGrid& grid, int axis, const AxisStencil& stencil) {
    for (int n = 0; n < stencil.nodes; ++n)
        if (grid.wrapped(axis, stencil.layer[n]) < 0) return false;
    return true;
}

using PlaneStencil = std::array<AxisStencil, 2>;

/// Quadratic where it fits, else linear, else without nodes.
PlaneStencil plane_stencil(const CellGrid& grid, const Eigen::Vector3d& x,
                           const Eigen::Vector3d& normal) {
    PlaneStencil along;
    for (int axis = 0; axis < 2; ++axis)
        along[axis] = quadratic_outward(grid, axis, x[axis], normal[axis]);
    if (fits(grid, 0, along[0]) && fits(grid, 1, along[1])) return along;
    for (int axis = 0; axis < 2; ++axis) along[axis] = linear(grid, axis, x[axis]);
    if (fits(grid, 0, along[0]) && fits(grid, 1, along[1])) return along;
    return {};
}

/// Calls visit(cell, arm) for the known cells whose centre the grain contains.
template <class Visit>
void for_cells_inside(const FluidField& field, const ImmersedGrain& grain, Visit visit) {
    const CellGrid& grid = field.grid();
    std::array<int, 2> low{}, high{};
    for (int axis = 0; axis < 2; ++axis) {
        low[axis] = grid.layer(axis, grain.position[axis] - grain.radius);
        high[axis] = grid.layer(axis, grain.position[axis] + grain.radius);
    }
    const Eigen::Matrix3d to_body = grain.orientation.transpose();
    for (int j = low[1]; j <= high[1]; ++j) {
        const int row = grid.wrapped(1, j);
        if (row < 0) continue;
        for (int i = low[0]; i <= high[0]; ++i) {
            const int column = grid.wrapped(0, i);
            if (column < 0) continue;
            const Eigen::Vector3d arm(grid.centre(0, i) - grain.position.x(),
                                      grid.centre(1, j) - grain.position.y(), 0.0);
            if (!grain.shape->contains(to_body * arm, grain.radius)) continue;
            const int cell = field.cell(column, row, 0);
            if (cell >= 0) visit(cell, arm);
        }
    }
}

double relative_depth(const ImmersedGrain& grain, const Eigen::Vector3d& arm) {
    return arm.squaredNorm() / (grain.radius * grain.radius);
}

}  // namespace

void PointPlacement::place(const FluidField& field, const std::vector<ImmersedGrain>& grains,
                           CollocationPoints& points) {
    if (field.grid().dimension != 2)
        throw std::invalid_argument("multiplier points exist in two dimensions only so far");
    owner_.resize(field.local_cells(), -1);
    depth_.resize(field.local_cells());
    stencilled_.resize(field.local_cells(), 0);

    find_candidates(field, grains);
    apply_wall_rule(field.grid(), grains);
    apply_grain_rules(field.grid(), grains);
    build_stencils(field, grains);
    mark_stencils(points);
    claim_cells(field, grains);
    collect(field, points);
    count_dropped(points);
    forget(points);
}

void PointPlacement::find_candidates(const FluidField& field,
                                     const std::vector<ImmersedGrain>& grains) {
    candidates_.clear();
    first_.assign(1, 0);
    const double h = field.grid().largest_spacing();
    for (const ImmersedGrain& grain : grains) {
        if (rules_.boundary)
            for (const SurfacePoint& point : surface_points(grain, rules_.spacing * h)) {
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
    std::vector<SurfacePoint>& ring = rings_[{grain.shape, grain.radius}];
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
                const double least = rules_.wall_distance * grid.spacing[axis];
                if ((grid.sides[axis][0] == Side::wall && from_lower < least) ||
                    (grid.sides[axis][1] == Side::wall && from_upper < least))
                    candidates_[c].fate = Fate::near_wall;
            }
}

void PointPlacement::apply_grain_rules(const CellGrid& grid,
                                       const std::vector<ImmersedGrain>& grains) {
    if (!rules_.boundary) return;
    const double reach = rules_.spacing * grid.largest_spacing();
    for (const auto& [a, b] : near_pairs(grid, grains, reach)) {
        compare(grid, grains, a, b);
        compare(grid, grains, b, a);
    }
}

void PointPlacement::compare(const CellGrid& grid, const std::vector<ImmersedGrain>& grains, int a,
                             int b) {
    const double reach = rules_.spacing * grid.largest_spacing();
    const double outer = grains[b].radius + reach;
    const Eigen::Vector3d apart = grid.nearest_image(grains[a].position - grains[b].position);
    const Eigen::Matrix3d to_body = grains[b].orientation.transpose();
    for (int c = first_[a]; c < first_[a + 1]; ++c) {
        Candidate& candidate = candidates_[c];
        const Eigen::Vector3d from_b = apart + candidate.arm;
        if (candidate.fate == Fate::near_wall || from_b.squaredNorm() > outer * outer) continue;
        if (grains[b].shape->contains(to_body * from_b, grains[b].radius))
            candidate.fate = Fate::inside_grain;
        if (candidate.fate == Fate::inside_grain) continue;
        for (int other = first_[b]; other < first_[b + 1]; ++other)
            if ((from_b - candidates_[other].arm).squaredNorm() < reach * reach)
                candidate.fate = Fate::near_point;
    }
}

/// Tensor product of two axes as cells and weights.
template <class Candidate>
void fill_stencil(const FluidField& field, const AxisStencil& along_x, const AxisStencil& along_y,
                  Candidate& point) {
    const CellGrid& grid = field.grid();
    point.cells = 0;
    for (int n = 0; n < along_y.nodes; ++n)
        for (int m = 0; m < along_x.nodes; ++m) {
            const double weight = along_x.weight[m] * along_y.weight[n];
            if (weight == 0.0) continue;
            const int cell =
                field.cell(grid.wrapped(0, along_x.layer[m]), grid.wrapped(1, along_y.layer[n]), 0);
            if (cell < 0) continue;  // beyond the halo: another rank's point
            point.cell[point.cells] = cell;
            point.weight[point.cells++] = weight;
        }
}

void PointPlacement::build_stencils(const FluidField& field,
                                    const std::vector<ImmersedGrain>& grains) {
    const CellGrid& grid = field.grid();
    for (std::size_t g = 0; g < grains.size(); ++g)
        for (int c = first_[g]; c < first_[g + 1]; ++c) {
            Candidate& point = candidates_[c];
            if (point.fate != Fate::kept) continue;
            const Eigen::Vector3d x = grains[g].position + point.arm;
            const PlaneStencil along = plane_stencil(grid, x, point.normal);
            if (along[0].nodes == 0) {
                point.fate = Fate::off_grid;
                continue;
            }
            const int home = field.cell(grid.wrapped(0, grid.layer(0, x[0])),
                                        grid.wrapped(1, grid.layer(1, x[1])), 0);
            point.owned = home >= 0 && field.owns(home);
            fill_stencil(field, along[0], along[1], point);
        }
}

void PointPlacement::mark_stencils(CollocationPoints& points) {
    points.stencilled.clear();
    for (const Candidate& point : candidates_) {
        if (point.fate != Fate::kept) continue;
        for (int n = 0; n < point.cells; ++n)
            if (!std::exchange(stencilled_[point.cell[n]], 1))
                points.stencilled.push_back(point.cell[n]);
    }
}

void PointPlacement::claim_cells(const FluidField& field,
                                 const std::vector<ImmersedGrain>& grains) {
    inside_.clear();
    inside_begin_.assign(1, 0);
    for (std::size_t g = 0; g < grains.size(); ++g) {
        for_cells_inside(field, grains[g], [&](int cell, const Eigen::Vector3d& arm) {
            const double depth = relative_depth(grains[g], arm);
            const int rival = owner_[cell];
            if (rival >= 0 && (depth > depth_[cell] ||
                               (depth == depth_[cell] && grains[g].id > grains[rival].id)))
                return;
            owner_[cell] = static_cast<int>(g);
            depth_[cell] = depth;
            inside_.push_back({cell, arm.x(), arm.y()});
        });
        inside_begin_.push_back(static_cast<int>(inside_.size()));
    }
}

void PointPlacement::collect(const FluidField& field, CollocationPoints& points) const {
    points.interior_begin.assign(1, 0);
    points.interior.clear();
    points.boundary_begin.assign(1, 0);
    points.arm_x.clear();
    points.arm_y.clear();
    points.stencil.assign(1, 0);
    points.cell.clear();
    points.weight.clear();
    for (int g = 0; g + 1 < static_cast<int>(first_.size()); ++g) {
        for (int i = inside_begin_[g]; i < inside_begin_[g + 1]; ++i) {
            const int cell = inside_[i].cell;
            if (owner_[cell] == g && !stencilled_[cell] && field.owns(cell))
                points.interior.push_back(inside_[i]);
        }
        points.interior_begin.push_back(static_cast<int>(points.interior.size()));
        collect_boundary(g, points);
        points.boundary_begin.push_back(points.boundary_points());
    }
}

void PointPlacement::collect_boundary(int g, CollocationPoints& points) const {
    for (int c = first_[g]; c < first_[g + 1]; ++c) {
        const Candidate& point = candidates_[c];
        if (point.fate != Fate::kept || !point.owned) continue;
        points.arm_x.push_back(point.arm.x());
        points.arm_y.push_back(point.arm.y());
        points.cell.insert(points.cell.end(), point.cell.begin(), point.cell.begin() + point.cells);
        points.weight.insert(points.weight.end(), point.weight.begin(),
                             point.weight.begin() + point.cells);
        points.stencil.push_back(static_cast<int>(points.cell.size()));
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
    for (const int cell : points.stencilled) stencilled_[cell] = 0;
    for (const InteriorCell& point : inside_) owner_[point.cell] = -1;
}

}  // namespace turbidite
