// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/space/sphere_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "fluid_adapter/multiplier/neighbours.hpp"

namespace turbidite {
namespace {

constexpr int x = 0, y = 1, z = 2;

/// Whether two bodies are parts of one rigid body, whatever their pivots:
/// v_a = v_b + omega x (X_a - X_b), to rounding.
bool move_as_one(const ImmersedGrain& a, const ImmersedGrain& b) {
    const Twist &own = a.contact_motion, &other = b.contact_motion;
    const Eigen::Vector3d arm = a.position - b.position;
    const double speeds = norm(own.velocity) + norm(other.velocity) + norm(own.spin) * arm.norm();
    return own.spin == other.spin &&
           norm(own.velocity - other.at({arm.x(), arm.y(), arm.z()})) <= 1e-12 * speeds;
}

}  // namespace

void SphereCells::find(const std::vector<ImmersedGrain>& grains) {
    grains_ = &grains;
    prescribed_.clear();
    for (const ImmersedGrain& grain : grains) prescribed_.push_back(grain.prescribed);
    shut_in_ = 0;
    owners_.clear();
    beside_runs_.clear();
    runs_.resize(grains.size());
    find_neighbours(grains);
    // Walls first: spheres get what they leave.
    const int bodies = static_cast<int>(grains.size());
    for (int g = 0; g < bodies; ++g)
        if (grains[g].wall) find_wall(g);
    for (int g = 0; g < bodies; ++g)
        if (!grains[g].wall) find_runs(g);
    join_shut_in();
}

/// Walls that are at rest are one body with the sides of the box, and those of one motion are one:
/// there are no wedges where they meet, through which fluid would leak.
int SphereCells::owner_of_wall(int wall) const {
    const ImmersedGrain& own = (*grains_)[wall];
    if (own.contact_motion.at_rest()) return CellOwners::wall;
    const auto first = std::find_if(
        grains_->begin(), grains_->end(),
        [&](const ImmersedGrain& body) { return body.wall && move_as_one(own, body); });
    return static_cast<int>(first - grains_->begin());
}

void SphereCells::find_wall(int wall) {
    runs_[wall].clear();
    const int owner = owner_of_wall(wall);
    for (const WallRun& run : walls_.find((*grains_)[wall]))
        add_cells(wall, owner, run.first, run.count, run.arm);
}

void SphereCells::find_runs(int g) {
    runs_[g].clear();
    const Eigen::Vector3d& at = (*grains_)[g].position;
    const double radius = (*grains_)[g].radius;
    const LayerSpan up = grid().layers_within(y, at.y(), radius);
    for (int j = up.low; j <= up.high; ++j) {
        const int layer = grid().wrapped(y, j);
        // Also of the layers beside this rank's, for the owners; add_run keeps only own cells.
        if (layer < 0 || !owners_.knows(layer)) continue;
        const double dy = up.cut ? arm(g, y, layer) : grid().centre(y, j) - at.y();
        // Half the width in z of the sphere's cut by this layer of centres
        const double across = std::sqrt(std::max(0.0, radius * radius - dy * dy));
        const LayerSpan deep = grid().layers_within(z, at.z(), across);
        for (int k = deep.low; k <= deep.high; ++k)
            if (const int row = grid().wrapped(z, k); row >= 0)
                find_row(
                    {g, layer, row, dy, deep.cut ? arm(g, z, row) : grid().centre(z, k) - at.z()});
    }
}

/// Those whose cells may touch each other.
void SphereCells::find_neighbours(const std::vector<ImmersedGrain>& grains) {
    neighbours_.assign(grains.size(), {});
    const auto& h = grid().spacing;
    const double margin = 2.0 * std::max({h[x], h[y], h[z]});
    for (const auto& [a, b] : near_pairs(grid(), grains, margin)) {
        if (grains[a].wall || grains[b].wall) continue;
        neighbours_[a].push_back(b);
        neighbours_[b].push_back(a);
    }
}

/// r of a cell's centre along an axis, of the image nearest to the grain. It depends on grain and
/// cell alone, so that all who ask agree to the last bit.
double SphereCells::arm(int grain, int axis, int wrapped) const {
    const double at = (*grains_)[grain].position[axis];
    double r = grid().centre(axis, wrapped) - at;
    if (grid().cyclic(axis)) r -= grid().length(axis) * std::round(r / grid().length(axis));
    return r;
}

double SphereCells::power(int grain, int i, int j, int k) const {
    const double rx = arm(grain, x, i), ry = arm(grain, y, j), rz = arm(grain, z, k);
    const double radius = (*grains_)[grain].radius;
    return rx * rx + ry * ry + rz * rz - radius * radius;
}

bool SphereCells::belongs(int grain, int i, int j, int k) const {
    const double own = power(grain, i, j, k);
    if (own >= 0.0) return false;
    for (const int other : neighbours_[grain]) {
        const double theirs = power(other, i, j, k);
        if (theirs < own) return false;
        // Otherwise a cell on the plane between them would have two owners.
        if (theirs == own && (*grains_)[other].id < (*grains_)[grain].id) return false;
    }
    return true;
}

/// The cells of one row: they follow each other.
void SphereCells::find_row(const Row& row) {
    const ImmersedGrain& grain = (*grains_)[row.grain];
    const double square = grain.radius * grain.radius - row.dy * row.dy - row.dz * row.dz;
    if (square <= 0.0) return;
    // Half a chord, rounded outwards to whole cells; `belongs` decides at both ends. Between them
    // nothing needs to be asked: the sphere, cut by planes, is convex.
    const double half = std::sqrt(square), at = grain.position[x];
    const LayerSpan across = grid().layers_within(x, at, half);
    int low = across.low, high = across.high;
    if (!grid().cyclic(x)) low = std::max(low, 0), high = std::min(high, grid().counts[x] - 1);
    const auto mine = [&](int i) { return belongs(row.grain, grid().wrapped(x, i), row.j, row.k); };
    while (low <= high && !mine(low)) ++low;
    while (high >= low && !mine(high)) --high;
    if (low <= high) add_run(row, low, high);
}

/// Cells low .. high, not wrapped; in two parts where they cross a cyclic side.
void SphereCells::add_run(const Row& row, int low, int high) {
    const int nx = grid().counts[x];
    while (low <= high) {
        const int i = grid().wrapped(x, low);
        // Up to the side of the grid
        const int count = std::min(high - low + 1, nx - i);
        const Eigen::Vector3d first(arm(row.grain, x, i), arm(row.grain, y, row.j),
                                    arm(row.grain, z, row.k));
        add_cells(row.grain, row.grain, {i, row.j, row.k}, count, first);
        low += count;
    }
}

/// Of cells along x within the grid those that no wall has; `arm`: r of the first.
void SphereCells::add_cells(int body, int owner, const CellPlace& first, int count,
                            const Eigen::Vector3d& arm) {
    const int* owners = owners_.row(first.j, first.k) + first.i;
    const Eigen::Vector3d step = grid().spacing[x] * Eigen::Vector3d::UnitX();
    for (int from = 0, to = 0; from < count; from = to) {
        const bool free = owners[from] == CellOwners::none;
        while (to < count && (owners[to] == CellOwners::none) == free) ++to;
        if (!free) continue;
        const CellPlace at{first.i + from, first.j, first.k};
        owners_.set(at, to - from, owner);
        if (const int after = grid().wrapped(x, first.i + to); after >= 0)
            beside_runs_.push_back({body, {after, at.j, at.k}, arm + to * step});
        if (at.i == 1 && !grid().cyclic(x))
            beside_runs_.push_back({body, {0, at.j, at.k}, arm + (from - 1) * step});
        if (cells_.owns(at.j))
            runs_[body].push_back({cells_.cell(at.i, at.j, at.k), to - from, arm + from * step,
                                   grid().relative_volume(at.i, at.j)});
    }
}

/// A cell that is shut in follows a run, or lies between a run and a wall.
void SphereCells::join_shut_in() {
    std::vector<CellOfGrain> joined;
    // Found once, by the covered neighbour at -x: no two runs end at the same cell.
    for (const CellOfGrain& of : beside_runs_)
        if (is_shut_in(of.at)) joined.push_back({nearest(of), of.at, of.arm});
    // The sums of a sphere with several of them do not depend on the order of the grains.
    std::sort(joined.begin(), joined.end(), [](const CellOfGrain& a, const CellOfGrain& b) {
        return std::tie(a.at.j, a.at.k, a.at.i) < std::tie(b.at.j, b.at.k, b.at.i);
    });
    // Only now: nor does whether a cell is shut in.
    for (const CellOfGrain& of : joined) {
        const auto [i, j, k] = of.at;
        owners_.set(of.at, 1, CellOwners::shut_in);
        if (!cells_.owns(j)) continue;
        ++shut_in_;
        const Eigen::Vector3d closest(arm(of.grain, x, i), arm(of.grain, y, j),
                                      arm(of.grain, z, k));
        runs_[of.grain].push_back({cells_.cell(i, j, k), 1,
                                   (*grains_)[of.grain].wall ? of.arm : closest,
                                   grid().relative_volume(i, j)});
    }
}

bool SphereCells::is_shut_in(const CellPlace& at) const {
    // The outermost of the known layers have unknown neighbours.
    if (!owners_.knows_beside(at.j) || owners_[at] != CellOwners::none) return false;
    for (const int axis : {x, y, z})
        for (const int side : {-1, 1})
            if (!owners_.covered(at.beside(axis, side))) return false;
    return true;
}

/// Of the spheres that cover the six cells around it; where walls do, the one that it follows.
int SphereCells::nearest(const CellOfGrain& of) const {
    const auto key = [&](int g) {
        return std::make_pair(power(g, of.at.i, of.at.j, of.at.k), (*grains_)[g].id);
    };
    int best = CellOwners::none;
    for (const int axis : {x, y, z})
        for (const int side : {-1, 1}) {
            const int owner = owners_[of.at.beside(axis, side)];
            if (owner < 0 || (*grains_)[owner].wall) continue;
            if (best < 0 || key(owner) < key(best)) best = owner;
        }
    return best < 0 ? of.grain : best;
}

const Wedges& SphereCells::find_wedges() {
    wedges_.clear();
    for (const std::vector<CellRun>& runs : runs_)
        for (const CellRun& run : runs) wedges_.add_run(place_of(run.cell), run.count);
    wedges_.find_sides(prescribed_);
    return wedges_;
}

CellPlace SphereCells::place_of(int cell) const {
    const int nx = grid().counts[x], nz = grid().counts[z];
    return {cell % nx, cells_.first + cell / (nx * nz), cell / nx % nz};
}

}  // namespace turbidite
