// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/space/wall_cells.hpp"

#include "fluid_adapter/multiplier/covered_share.hpp"

namespace turbidite {

const std::vector<WallRun>& WallCells::find(const ImmersedGrain& wall) {
    Found& found = found_[wall.id];
    const bool kept = found.body == *wall.wall && found.position == wall.position;
    if (!kept) found = {*wall.wall, wall.position, search(wall)};
    return found.runs;
}

std::vector<WallRun> WallCells::search(const ImmersedGrain& wall) const {
    const auto [first, last] = layers_reached_by(grid(), *wall.wall);
    std::vector<WallRun> runs;
    for (int j = first[1]; j <= last[1]; ++j) {
        const int layer = grid().wrapped(1, j);
        if (layer < 0 || !owners_.knows(layer)) continue;
        for (int k = first[2]; k <= last[2]; ++k)
            if (grid().wrapped(2, k) >= 0) search_row(wall, {first[0], j, k}, last[0], runs);
    }
    return runs;
}

/// Indices that are not wrapped: the place of a cell is that of the image at this wall.
void WallCells::search_row(const ImmersedGrain& wall, const CellPlace& first, int last,
                           std::vector<WallRun>& runs) const {
    // A centre at just this distance belongs to it, so that two cells are two wherever they lie.
    const double half = wall.wall->half_thickness + 1e-9 * grid().spacing[0];
    bool goes_on = false;
    const auto [low, j, k] = first;
    for (int i = low; i <= last; ++i) {
        const int column = grid().wrapped(0, i);
        const Vec3 centre{grid().centre(0, i), grid().centre(1, j), grid().centre(2, k)};
        if (column < 0 || distance(wall.wall->surface, centre) > half) {
            goes_on = false;
            continue;
        }
        if (goes_on && column > 0) {
            ++runs.back().count;
            continue;
        }
        const Eigen::Vector3d at(centre[0], centre[1], centre[2]);
        runs.push_back(
            {{column, grid().wrapped(1, j), grid().wrapped(2, k)}, 1, at - wall.position});
        goes_on = true;
    }
}

}  // namespace turbidite
