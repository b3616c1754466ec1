// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/space/sphere_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fluid_adapter/multiplier/neighbours.hpp"

namespace turbidite {
namespace {

constexpr int x = 0, y = 1, z = 2;

}  // namespace

void SphereCells::find(const std::vector<ImmersedGrain>& grains) {
    grains_ = &grains;
    shut_in_ = 0;
    // One layer more at either end: cells there are neighbours of own ones (join_if_shut_in).
    covered_.assign(
        grid().counts[x] * static_cast<std::size_t>(grid().counts[z]) * (cells_.count + 2), 0);
    runs_.resize(grains.size());
    find_neighbours(grains);
    for (std::size_t g = 0; g < grains.size(); ++g) find_runs(static_cast<int>(g));
    join_shut_in();
}

/// The layers within `reach` of a coordinate; of a sphere that reaches round a cyclic axis one
/// turn, those up to half a period away, else its first and last layers would be the same cells.
SphereCells::Layers SphereCells::layers(int axis, double at, double reach) const {
    Layers found{grid().layer(axis, at - reach), grid().layer(axis, at + reach), false};
    const int turn = grid().counts[axis];
    if (!grid().cyclic(axis) || found.high - found.low < turn) return found;
    found.low = grid().layer_below(axis, at - 0.5 * grid().length(axis)) + 1;
    found.high = found.low + turn - 1;
    found.cut = true;
    return found;
}

void SphereCells::find_runs(int g) {
    runs_[g].clear();
    const Eigen::Vector3d& at = (*grains_)[g].position;
    const double radius = (*grains_)[g].radius;
    const Layers up = layers(y, at.y(), radius);
    for (int j = up.low; j <= up.high; ++j) {
        const int layer = grid().wrapped(y, j);
        // Also of the layers beside this rank's, for the mask; add_run keeps only own cells.
        if (layer < 0 || mask_cell(0, layer, 0) >= covered_.size()) continue;
        const double dy = up.cut ? arm(g, y, layer) : grid().centre(y, j) - at.y();
        // Half the width in z of the sphere's cut by this layer of centres
        const double across = std::sqrt(std::max(0.0, radius * radius - dy * dy));
        const Layers deep = layers(z, at.z(), across);
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
    const Layers across = layers(x, at, half);
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
        for (int c = 0; c < count; ++c) mark(i + c, row.j, row.k);
        if (cells_.owns(row.j))
            runs_[row.grain].push_back(
                {cells_.cell(i, row.j, row.k),
                 count,
                 {arm(row.grain, x, i), arm(row.grain, y, row.j), arm(row.grain, z, row.k)},
                 grid().relative_volume(i, row.j)});
        low += count;
    }
}

/// Index in `covered_` of a cell of the grid; its size for a cell that is not looked at.
std::size_t SphereCells::mask_cell(int i, int j, int k) const {
    const int ny = grid().counts[y];
    // 0 is the layer below the rank's, count + 1 that above, of a cyclic axis round the grid.
    int layer = j - cells_.first + 1;
    if (layer < 0) layer += ny;
    if (layer > cells_.count + 1) layer -= ny;
    if (layer < 0 || layer > cells_.count + 1) return covered_.size();
    return i + grid().counts[x] * (k + static_cast<std::size_t>(grid().counts[z]) * layer);
}

void SphereCells::mark(int i, int j, int k) {
    if (const std::size_t cell = mask_cell(i, j, k); cell < covered_.size()) covered_[cell] = 1;
}

/// A cell beyond a wall is; indices need not be wrapped.
bool SphereCells::is_covered(int i, int j, int k) const {
    const std::array<int, 3> place{i, j, k};
    std::array<int, 3> at;
    for (const int axis : {x, y, z}) {
        at[axis] = grid().wrapped(axis, place[axis]);
        if (at[axis] < 0) return grid().sides[axis][place[axis] < 0 ? 0 : 1] == Side::wall;
    }
    const std::size_t cell = mask_cell(at[x], at[y], at[z]);
    return cell < covered_.size() && covered_[cell] != 0;
}

/// A cell that is shut in follows a run, or lies between a run and a wall.
void SphereCells::join_shut_in() {
    std::vector<Joined> joined;
    for (std::size_t g = 0; g < runs_.size(); ++g)
        for (const CellRun& run : runs_[g]) {
            const Place at = place_of(run.cell);
            // Found once, by the covered neighbour at -x: no two runs end at the same cell.
            join_if_shut_in(static_cast<int>(g), {at.i + run.count, at.j, at.k}, joined);
            if (at.i == 1 && !grid().cyclic(x))
                join_if_shut_in(static_cast<int>(g), {0, at.j, at.k}, joined);
        }
    // Only now: whether a cell is shut in does not depend on the order of the grains.
    for (const Joined& of : joined) {
        const Place& at = of.at;
        runs_[of.grain].push_back(
            {cells_.cell(at.i, at.j, at.k),
             1,
             {arm(of.grain, x, at.i), arm(of.grain, y, at.j), arm(of.grain, z, at.k)},
             grid().relative_volume(at.i, at.j)});
    }
    shut_in_ = static_cast<int>(joined.size());
}

SphereCells::Place SphereCells::place_of(int cell) const {
    const int nx = grid().counts[x], nz = grid().counts[z];
    return {cell % nx, cells_.first + cell / (nx * nz), cell / nx % nz};
}

void SphereCells::join_if_shut_in(int beside, Place at, std::vector<Joined>& joined) const {
    at.i = grid().wrapped(x, at.i);
    const auto [i, j, k] = at;
    if (i < 0 || is_covered(i, j, k)) return;
    const bool shut = is_covered(i + 1, j, k) && is_covered(i - 1, j, k) &&
                      is_covered(i, j + 1, k) && is_covered(i, j - 1, k) &&
                      is_covered(i, j, k + 1) && is_covered(i, j, k - 1);
    if (shut) joined.push_back({nearest(beside, at), at});
}

/// Of a grain and its neighbours.
int SphereCells::nearest(int grain, const Place& at) const {
    const auto key = [&](int g) {
        return std::make_pair(power(g, at.i, at.j, at.k), (*grains_)[g].id);
    };
    int best = grain;
    for (const int other : neighbours_[grain])
        if (key(other) < key(best)) best = other;
    return best;
}

}  // namespace turbidite
