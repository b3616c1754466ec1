// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/broad_phase.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <string>

#include "coupler/shapes/shortest_period.hpp"

namespace turbidite::nscd {
namespace {

/// The cells of one axis touched by a search interval: `count` cells from `first` on, modulo n.
struct CellRange {
    std::int64_t first = 0;
    std::int64_t count = 0;
};

struct Axis {
    double origin = 0.0;
    double cell = 1.0;
    std::int64_t n = 1;
    bool repeats = false;

    std::int64_t raw(double x) const {
        return static_cast<std::int64_t>(std::floor((x - origin) / cell));
    }

    // x may lie outside a periodic axis, and by rounding beyond either end of the others.
    std::int64_t index(double x) const {
        const std::int64_t i = raw(x);
        return repeats ? ((i % n) + n) % n : std::clamp<std::int64_t>(i, 0, n - 1);
    }

    /// Index of a cell at most one period beyond the last. Avoids a division, the most expensive
    /// operation in near().
    std::int64_t wrapped(std::int64_t i) const { return i < n ? i : i - n; }

    CellRange range(double low, double high) const {
        // Cells that [low, high] touches, each at most once.
        const std::int64_t first = raw(low), last = raw(high);
        if (repeats) {
            if (last - first + 1 >= n) return {0, n};
            return {((first % n) + n) % n, last - first + 1};
        }
        if (last < 0 || first >= n) return {};
        const std::int64_t inside = std::max<std::int64_t>(first, 0);
        return {inside, std::min(last, n - 1) - inside + 1};
    }
};

/// Splits [low, high] into cells no smaller than `cell`; equal cells on a periodic axis.
Axis make_axis(double low, double high, double cell, bool repeats) {
    Axis axis{low, cell, 1, repeats};
    const double ratio = std::floor((high - low) / cell);
    // More cells than this are never useful, and the cast below must not overflow.
    // Cells of a periodic axis share its length; elsewhere the last one holds `high`, hence + 1.
    const double cells = std::clamp(repeats ? ratio : ratio + 1.0, 1.0, 1e6);
    axis.n = static_cast<std::int64_t>(cells);
    if (repeats) axis.cell = (high - low) / cells;
    // Fewer and wider cells, with `high` still in the last one.
    if (!repeats && ratio + 1.0 > cells) axis.cell = (high - low) / (cells - 1.0);
    return axis;
}

/// Bodies of one size class, sorted into the cells of a grid.
class Level {
 public:
    Level(std::vector<std::int32_t> members, const std::vector<Vec3>& x, double cell,
          const PeriodicBox& box);

    /// Calls visit(j, place of j) for the members in cells that touch the cube x +- reach, except
    /// the first `left_out` ones.
    template <class Visit>
    void near(const Vec3& x, double reach, std::int32_t left_out, Visit&& visit) const;

    /// Cell by cell.
    const std::vector<std::int32_t>& members() const { return members_; }

 private:
    void lay_axes(const std::vector<Vec3>& x, double cell, const PeriodicBox& box);
    void sort_members(const std::vector<Vec3>& x);
    std::size_t cell_of(const Vec3& x) const {
        return static_cast<std::size_t>((axes_[2].index(x[2]) * axes_[1].n + axes_[1].index(x[1])) *
                                            axes_[0].n +
                                        axes_[0].index(x[0]));
    }

    std::vector<std::int32_t> members_;
    std::vector<Vec3> places_;  ///< of the members
    std::array<Axis, 3> axes_;
    std::vector<std::int32_t> start_;  ///< first member of each cell
};

Level::Level(std::vector<std::int32_t> members, const std::vector<Vec3>& x, double cell,
             const PeriodicBox& box)
    : members_(std::move(members)) {
    // Widely scattered bodies would need more cells than there are bodies; coarser cells are still
    // correct.
    const auto limit = static_cast<std::int64_t>(4 * members_.size() + 64);
    lay_axes(x, cell, box);
    while (axes_[0].n * axes_[1].n * axes_[2].n > limit) lay_axes(x, cell *= 1.5, box);
    sort_members(x);
}

void Level::lay_axes(const std::vector<Vec3>& x, double cell, const PeriodicBox& box) {
    for (int axis = 0; axis < 3; ++axis) {
        double low = x[members_.front()][axis], high = low;
        for (const std::int32_t i : members_) {
            low = std::min(low, x[i][axis]);
            high = std::max(high, x[i][axis]);
        }
        if (box.repeats(axis)) low = box.lower[axis], high = low + box.length[axis];
        axes_[axis] = make_axis(low, high, cell, box.repeats(axis));
    }
}

void Level::sort_members(const std::vector<Vec3>& x) {
    // Sorting by counting: start_[c] is the number of members in cells before c. Members of a cell
    // keep their order, so that the order of the pairs depends only on the input.
    start_.assign(static_cast<std::size_t>(axes_[0].n * axes_[1].n * axes_[2].n) + 1, 0);
    for (const std::int32_t i : members_) ++start_[cell_of(x[i]) + 1];
    for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    std::vector<std::int32_t> next(start_.begin(), start_.end() - 1), sorted(members_.size());
    for (const std::int32_t i : members_) sorted[next[cell_of(x[i])]++] = i;
    members_ = std::move(sorted);
    places_.reserve(members_.size());
    for (const std::int32_t i : members_) places_.push_back(x[i]);
}

// The cells of a row are contiguous in memory, and so are their members.
template <class Visit>
void Level::near(const Vec3& x, double reach, std::int32_t left_out, Visit&& visit) const {
    std::array<CellRange, 3> range;
    for (int axis = 0; axis < 3; ++axis)
        range[axis] = axes_[axis].range(x[axis] - reach, x[axis] + reach);
    // Along x a row may run over the end of a periodic axis: it continues in the first cells.
    const std::int64_t end = range[0].first + range[0].count;
    const std::int64_t inside = std::min(end, axes_[0].n), wrapped = end - inside;
    const auto row = [&](std::int64_t first, std::int64_t last) {
        for (std::int32_t k = std::max(start_[first], left_out); k < start_[last]; ++k)
            visit(members_[k], places_[k]);
    };
    for (std::int64_t kz = 0; kz < range[2].count; ++kz)
        for (std::int64_t ky = 0; ky < range[1].count; ++ky) {
            const std::int64_t cy = axes_[1].wrapped(range[1].first + ky);
            const std::int64_t cz = axes_[2].wrapped(range[2].first + kz);
            const std::int64_t first = (cz * axes_[1].n + cy) * axes_[0].n;
            row(first + range[0].first, first + inside);
            row(first, first + wrapped);
        }
}

/// 0 for bodies larger than half the largest, 1 for those larger than a quarter, ...
int level_of(double radius, double largest) {
    return static_cast<int>(std::floor(std::log2(largest / radius)));
}

struct SizedLevel {
    double largest;  ///< radius
    Level grid;
};

/// From the level of the largest bodies to that of the smallest.
std::map<int, SizedLevel> build_levels(const std::vector<Vec3>& x, const std::vector<double>& radii,
                                       double alert, const PeriodicBox& box) {
    const double largest = *std::max_element(radii.begin(), radii.end());
    std::map<int, std::vector<std::int32_t>> members;
    for (std::size_t i = 0; i < radii.size(); ++i)
        members[level_of(radii[i], largest)].push_back(static_cast<std::int32_t>(i));
    std::map<int, SizedLevel> levels;
    for (auto& [level, list] : members) {
        double top = 0.0;
        for (const std::int32_t i : list) top = std::max(top, radii[i]);
        // The largest pair distance within the level, 2 r_top + alert, is the edge of its cells.
        levels.emplace(level, SizedLevel{top, Level(std::move(list), x, 2.0 * top + alert, box)});
    }
    return levels;
}

/// Bodies in their cells.
class CellLists {
 public:
    CellLists(const std::vector<Vec3>& x, const std::vector<double>& radii, double alert,
              const PeriodicBox& box)
        : x_(x),
          radii_(radii),
          alert_(alert),
          box_(box),
          levels_(build_levels(x, radii, alert, box)) {}

    /// A body that looks for its pairs. Within a level both bodies would find the pair: one of them
    /// leaves out the first members of the level, or those with a lower index.
    struct Searcher {
        std::int32_t body;
        std::int32_t left_out = 0;
    };
    std::vector<Searcher> searchers(PairOrder order) const {
        std::vector<Searcher> result;
        result.reserve(x_.size());
        if (order == PairOrder::by_body)
            for (std::size_t i = 0; i < x_.size(); ++i)
                result.push_back({static_cast<std::int32_t>(i)});
        else
            for (const auto& [level, sized] : levels_)
                for (std::int32_t before = 0; const std::int32_t i : sized.grid.members())
                    result.push_back({i, ++before});
        return result;
    }

    /// Adds the pairs that a body finds.
    void search(const Searcher& searcher, std::vector<Pair>& pairs) const {
        const std::int32_t i = searcher.body;
        const bool by_index = searcher.left_out == 0;
        const int own = level_of(radii_[i], levels_.begin()->second.largest);
        for (const auto& [level, sized] : levels_) {
            if (level > own) break;  // smaller bodies search for this one
            sized.grid.near(x_[i], radii_[i] + sized.largest + alert_,
                            level == own ? searcher.left_out : 0,
                            [&](std::int32_t j, const Vec3& place) {
                                if (level == own && by_index && j <= i) return;
                                const Vec3 d = box_.minimum_image(place - x_[i]);
                                const double reach = radii_[i] + radii_[j] + alert_;
                                if (dot(d, d) < reach * reach)
                                    pairs.push_back({std::min(i, j), std::max(i, j)});
                            });
        }
    }

 private:
    const std::vector<Vec3>& x_;
    const std::vector<double>& radii_;
    double alert_;
    const PeriodicBox& box_;
    std::map<int, SizedLevel> levels_;
};

}  // namespace

std::vector<std::vector<Pair>> candidate_pairs(const std::vector<Vec3>& x,
                                               const std::vector<double>& radii, double alert,
                                               const PeriodicBox& box, PairOrder order,
                                               ThreadTeam& team) {
    std::vector<std::vector<Pair>> parts(static_cast<std::size_t>(team.size()));
    if (x.empty()) return parts;
    const CellLists lists(x, radii, alert, box);
    const std::vector<CellLists::Searcher> searchers = lists.searchers(order);
    team.run([&](int thread) {
        std::vector<Pair> pairs;
        const std::size_t end = team.part_begin(searchers.size(), thread + 1);
        for (std::size_t k = team.part_begin(searchers.size(), thread); k < end; ++k)
            lists.search(searchers[k], pairs);
        parts[static_cast<std::size_t>(thread)] = std::move(pairs);
    });
    return parts;
}

std::vector<Pair> candidate_pairs(const std::vector<Vec3>& x, const std::vector<double>& radii,
                                  double alert, const PeriodicBox& box) {
    ThreadTeam alone(1);
    return std::move(candidate_pairs(x, radii, alert, box, PairOrder::by_body, alone).front());
}

void check_periods(const std::vector<double>& radii, const std::vector<std::uint8_t>& fixed,
                   double range, const PeriodicBox& box) {
    ShortestPeriod shortest;
    for (std::size_t i = 0; i < radii.size(); ++i) shortest.add(radii[i], fixed[i] != 0);
    for (int axis = 0; axis < 3; ++axis)
        if (box.repeats(axis) && !shortest.allows(box.length[axis], range))
            throw std::invalid_argument(
                "the domain repeats after " + std::to_string(box.length[axis]) + " along axis " +
                std::to_string(axis) +
                (shortest.pair() > 0.0
                     ? ": two grains could touch, or attract each other, on both sides; make it "
                       "more than "
                     : ": a grain would overlap with itself; make it at least ") +
                std::to_string(shortest.length(range)));
}

}  // namespace turbidite::nscd
