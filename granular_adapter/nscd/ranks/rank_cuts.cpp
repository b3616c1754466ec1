// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/ranks/rank_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace turbidite::nscd {
namespace {

/// The axis along which the cells are spread farthest.
int longest_axis(const std::vector<CellLoad>& loads) {
    int longest = 0;
    double length = -1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax_element(loads.begin(), loads.end(),
                                                     [axis](const CellLoad& a, const CellLoad& b) {
                                                         return a.centre[axis] < b.centre[axis];
                                                     });
        const double own = high->centre[axis] - low->centre[axis];
        if (own > length) length = own, longest = axis;
    }
    return longest;
}

/// Where the work up to a load, in order, is nearest to a share of all; between two layers of
/// cells, or the end.
std::size_t best_cut(const std::vector<CellLoad>& loads, int axis, double share) {
    double all = 0.0, below = 0.0, best = INFINITY;
    for (const CellLoad& load : loads) all += load.work;
    std::size_t cut = loads.size();
    for (std::size_t i = 0; i + 1 < loads.size(); ++i) {
        below += loads[i].work;
        // Cells of one layer have the same coordinate: no plane can separate them.
        if (!(loads[i].centre[axis] < loads[i + 1].centre[axis])) continue;
        const double off = std::abs(below - share * all);
        if (off < best) best = off, cut = i + 1;
    }
    return cut;
}

}  // namespace

RankCuts::RankCuts(std::vector<CellLoad> loads, int ranks) {
    cuts_.clear();
    add(std::move(loads), 0, ranks);
}

std::size_t RankCuts::add(std::vector<CellLoad> loads, int first, int ranks) {
    const std::size_t own = cuts_.size();
    cuts_.push_back({-1, 0.0, first, 0, 0});
    if (ranks == 1 || loads.empty()) return own;
    const int axis = longest_axis(loads), below = ranks / 2;
    std::sort(loads.begin(), loads.end(), [axis](const CellLoad& a, const CellLoad& b) {
        // The whole centre breaks ties, so that the cuts do not depend on which rank gave a load
        // first.
        return std::tie(a.centre[axis], a.centre) < std::tie(b.centre[axis], b.centre);
    });
    const std::size_t cut =
        best_cut(loads, axis, static_cast<double>(below) / static_cast<double>(ranks));
    // All cells in one layer: they stay on the first of these ranks, and the others have none.
    if (cut == loads.size()) return own;
    const auto middle = loads.begin() + static_cast<std::ptrdiff_t>(cut);
    // Half-way between two layers of centres: no centre lies on the plane.
    const double at = 0.5 * (loads[cut - 1].centre[axis] + loads[cut].centre[axis]);
    const std::size_t low = add({loads.begin(), middle}, first, below);
    const std::size_t high = add({middle, loads.end()}, first + below, ranks - below);
    cuts_[own] = {axis, at, first, low, high};
    return own;
}

int RankCuts::rank(const Vec3& x) const {
    const Cut* cut = &cuts_.front();
    while (cut->axis >= 0)
        cut = &cuts_[x[static_cast<std::size_t>(cut->axis)] < cut->at ? cut->below : cut->above];
    return cut->rank;
}

}  // namespace turbidite::nscd
