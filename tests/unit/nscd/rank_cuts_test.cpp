// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Cells are shared out evenly, and contacts of cells are grouped cell by cell.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "granular_adapter/nscd/ranks/rank_cuts.hpp"
#include "granular_adapter/nscd/sweeps/cell_schedule.hpp"

namespace turbidite::nscd {
namespace {

std::vector<CellLoad> cells(int nx, int ny, int nz) {
    std::vector<CellLoad> loads;
    for (int x = 0; x < nx; ++x)
        for (int y = 0; y < ny; ++y)
            for (int z = 0; z < nz; ++z)
                loads.push_back({{5.0 * x, 5.0 * y, 5.0 * z}, 100.0 + x + 10.0 * y});
    return loads;
}

TEST(RankCuts, ShareTheWorkOut) {
    for (const int ranks : {1, 2, 3, 4, 5, 8}) {
        const std::vector<CellLoad> loads = cells(12, 6, 10);
        const RankCuts cuts(loads, ranks);
        std::vector<double> work(static_cast<std::size_t>(ranks), 0.0);
        double all = 0.0;
        for (const CellLoad& load : loads) {
            work.at(static_cast<std::size_t>(cuts.rank(load.centre))) += load.work;
            all += load.work;
        }
        EXPECT_LT(*std::max_element(work.begin(), work.end()) * ranks, 1.3 * all) << ranks;
        EXPECT_GT(*std::min_element(work.begin(), work.end()), 0.0) << ranks;
    }
}

TEST(RankCuts, DoNotDependOnTheOrderOfTheCells) {
    std::vector<CellLoad> loads = cells(7, 3, 5);
    const RankCuts one(loads, 4);
    std::mt19937_64 random(1);
    std::shuffle(loads.begin(), loads.end(), random);
    const RankCuts other(loads, 4);
    for (const CellLoad& load : loads) EXPECT_EQ(one.rank(load.centre), other.rank(load.centre));
}

TEST(RankCuts, OneCellIsNotCut) {
    const RankCuts cuts({{{1, 2, 3}, 10.0}}, 3);
    EXPECT_EQ(cuts.rank({1, 2, 3}), 0);
    EXPECT_EQ(cuts.rank({-100, 2, 300}), 0);
    EXPECT_EQ(RankCuts({}, 3).rank({1, 2, 3}), 0);
    EXPECT_EQ(RankCuts().rank({1, 2, 3}), 0);
}

/// Random pairs of 400 bodies, some of them immovable, in cells of different sizes.
struct Contacts {
    std::vector<MovedPair> pairs;
    std::vector<std::uint8_t> active;
    ContactCells cells;
};

Contacts contacts() {
    std::mt19937_64 random(5);
    const auto any = [&](int below) { return static_cast<std::int32_t>(random() % below); };
    Contacts result;
    for (const int size : {1, 30, 700, 0, 2500}) {
        for (int i = 0; i < size; ++i) {
            const std::int32_t a = any(400), b = any(400);
            result.pairs.push_back({a % 20 == 0 || a == b ? -1 : a, b % 20 == 0 ? -1 : b});
            result.active.push_back(any(3) == 0 ? 1 : 0);
        }
        result.cells.place.push_back(result.cells.place.size());
        result.cells.end.push_back(static_cast<std::int32_t>(result.pairs.size()));
    }
    return result;
}

// Every contact is in one lane, groups share no body and stay apart, and no group has contacts of
// two cells or of both kinds.
TEST(CellSchedule, GroupsAreOfOneCell) {
    const Contacts given = contacts();
    const Schedule schedule =
        make_cell_schedule(given.pairs, given.active, 400, {}, given.cells, {2, 5});
    EXPECT_EQ(schedule.cell_ends.size(), 5u);
    EXPECT_EQ(schedule.phase_ends,
              (std::vector<std::size_t>{schedule.cell_ends[1], schedule.cell_ends[4]}));
    std::set<std::int32_t> seen;
    for (std::size_t cell = 0, s = 0; cell < 5; ++cell)
        for (; s < schedule.cell_ends[cell]; ++s)
            for (const bool moving : {true, false}) {
                const Stretch& stretch = schedule.stretches[s];
                const GroupRange range = moving ? stretch.active : stretch.resting;
                std::vector<std::int32_t> last(400, -2);
                for (std::int32_t i = 4 * range.first; i < 4 * range.last; ++i) {
                    const std::int32_t k = schedule.lanes[static_cast<std::size_t>(i)];
                    if (k < 0) continue;
                    EXPECT_TRUE(seen.insert(k).second);
                    EXPECT_GE(k, given.cells.first(cell));
                    EXPECT_LT(k, given.cells.end[cell]);
                    EXPECT_EQ(given.active[static_cast<std::size_t>(k)] != 0, moving);
                    const MovedPair& pair = given.pairs[static_cast<std::size_t>(k)];
                    for (const std::int32_t body : {pair.a, pair.b}) {
                        if (body < 0) continue;
                        EXPECT_GE(i / 4 - last[static_cast<std::size_t>(body)], 2);
                        last[static_cast<std::size_t>(body)] = i / 4;
                    }
                }
            }
    EXPECT_EQ(seen.size(), given.pairs.size());
}

// The groups of a cell are the same whatever the other cells are.
TEST(CellSchedule, ACellDoesNotKnowTheOthers) {
    const Contacts given = contacts();
    const Schedule all = make_cell_schedule(given.pairs, given.active, 400, {}, given.cells);
    const std::int32_t first = given.cells.first(2), end = given.cells.end[2];
    const Schedule one = make_cell_schedule(
        {given.pairs.begin() + first, given.pairs.begin() + end},
        {given.active.begin() + first, given.active.begin() + end}, 400, {}, {{0}, {end - first}});
    const Stretch& there = all.stretches[all.cell_ends[1]];
    ASSERT_GT(one.active, 10);
    for (std::int32_t i = 0; i < 4 * one.stretches[0].active.last; ++i) {
        const std::int32_t k = one.lanes[static_cast<std::size_t>(i)];
        EXPECT_EQ(all.lanes[static_cast<std::size_t>(4 * there.active.first + i)],
                  k < 0 ? k : k + first);
    }
}

}  // namespace
}  // namespace turbidite::nscd
