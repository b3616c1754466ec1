// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/neighbours.hpp"

#include <algorithm>

namespace turbidite {
namespace {

/// Square bins at least as wide as the interaction distance.
class Bins {
 public:
    Bins(const CellGrid& grid, double reach) : grid_(grid) {
        for (int axis = 0; axis < grid.dimension; ++axis)
            // Rounded down: a bin is at least as wide as `reach`.
            counts_[axis] = std::max(1, static_cast<int>(grid.length(axis) / reach));
        lists_.resize(static_cast<std::size_t>(counts_[0]) * counts_[1] * counts_[2]);
    }

    void add(int grain, const Eigen::Vector3d& position) {
        lists_[number(place(position))].push_back(grain);
    }

    /// The bins around a position, each once even where the grid is only two bins wide.
    const std::vector<int>& around(const Eigen::Vector3d& position) {
        near_.clear();
        const std::array<int, 3> centre = place(position);
        const int deep = grid_.dimension == 3 ? 1 : 0;
        for (int k = -deep; k <= deep; ++k)
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i)
                    add_near({centre[0] + i, centre[1] + j, centre[2] + k});
        std::sort(near_.begin(), near_.end());
        near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
        return near_;
    }

    const std::vector<int>& grains(int bin) const { return lists_[bin]; }

 private:
    std::array<int, 3> place(const Eigen::Vector3d& position) const {
        std::array<int, 3> index{0, 0, 0};
        for (int axis = 0; axis < grid_.dimension; ++axis) {
            double part = (position[axis] - grid_.origin[axis]) / grid_.length(axis);
            if (grid_.cyclic(axis)) part -= std::floor(part);
            // A body that has left the grid counts to the bin at the side.
            const int i = static_cast<int>(std::floor(part * counts_[axis]));
            index[axis] = std::clamp(i, 0, counts_[axis] - 1);
        }
        return index;
    }

    void add_near(std::array<int, 3> index) {
        for (int axis = 0; axis < grid_.dimension; ++axis) {
            const int n = counts_[axis];
            // With one or two bins around, a bin is its own neighbour, or is met from both sides.
            if (grid_.cyclic(axis)) index[axis] = (index[axis] + n) % n;
            if (index[axis] < 0 || index[axis] >= n) return;
        }
        near_.push_back(number(index));
    }

    int number(const std::array<int, 3>& index) const {
        return index[0] + counts_[0] * (index[1] + counts_[1] * index[2]);
    }

    const CellGrid& grid_;
    std::array<int, 3> counts_{1, 1, 1};
    std::vector<std::vector<int>> lists_;
    std::vector<int> near_;
};

/// Bodies that are much larger than most, such as long plates, would make the bins useless: they
/// are compared with all others.
constexpr double much_larger = 4.0;

double mean_radius(const std::vector<ImmersedGrain>& grains) {
    double sum = 0.0;
    for (const ImmersedGrain& grain : grains) sum += grain.radius;
    return sum / static_cast<double>(grains.size());
}

double largest_radius(const std::vector<ImmersedGrain>& grains, double limit) {
    double radius = 0.0;
    for (const ImmersedGrain& grain : grains)
        if (grain.radius <= limit) radius = std::max(radius, grain.radius);
    return radius;
}

}  // namespace

std::vector<std::pair<int, int>> near_pairs(const CellGrid& grid,
                                            const std::vector<ImmersedGrain>& grains,
                                            double margin) {
    std::vector<std::pair<int, int>> pairs;
    if (grains.size() < 2) return pairs;
    // Two binned bodies that interact are at most one bin apart: |x_a - x_b| < 2 R_max + margin.
    const double limit = much_larger * mean_radius(grains);
    Bins bins(grid, 2.0 * largest_radius(grains, limit) + margin);
    std::vector<int> large, all;
    for (int b = 0; b < static_cast<int>(grains.size()); ++b) {
        const auto compare = [&](int a) {
            const Eigen::Vector3d apart =
                grid.nearest_image(grains[b].position - grains[a].position);
            const double reach = grains[a].radius + grains[b].radius + margin;
            if (apart.squaredNorm() < reach * reach) pairs.emplace_back(a, b);
        };
        // Only bodies with a smaller index are in the lists: each pair is found once.
        const bool binned = grains[b].radius <= limit;
        if (binned)
            for (const int bin : bins.around(grains[b].position))
                for (const int a : bins.grains(bin)) compare(a);
        for (const int a : binned ? large : all) compare(a);
        if (binned)
            bins.add(b, grains[b].position);
        else
            large.push_back(b);
        all.push_back(b);
    }
    return pairs;
}

}  // namespace turbidite
