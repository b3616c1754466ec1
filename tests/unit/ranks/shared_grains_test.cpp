// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/ranks/shared_grains.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace turbidite {
namespace {

/// Grains with large, non-contiguous ids; rank r holds those whose bits select it, rank 1 none at
/// all.
bool holds(int rank, GrainId id) {
    return rank != 1 && ((id >> rank) & 1) != 0;
}

constexpr GrainId first_id = GrainId{1} << 40, last_id = first_id + 48;

std::vector<GrainId> grains_of(int rank) {
    std::vector<GrainId> ids;
    for (GrainId id = last_id; id > first_id; id -= 3)
        if (holds(rank, id)) ids.push_back(id);
    return ids;
}

double row_of(int rank, GrainId id, int n) {
    return std::sin(1.0 + rank + 7.0 * static_cast<double>(id % 1000) + n);
}

/// In the order of the ranks, as the class promises, and so to the last bit.
double expected_sum(int ranks, GrainId id, int n) {
    double sum = 0.0;
    for (int rank = 0; rank < ranks; ++rank)
        if (holds(rank, id)) sum += row_of(rank, id, n);
    return sum;
}

void expect_sums(SharedGrains& shared, const RankGroup& group, const std::vector<GrainId>& ids,
                 int per_grain) {
    std::vector<double> rows;
    for (const GrainId id : ids)
        for (int n = 0; n < per_grain; ++n) rows.push_back(row_of(group.rank(), id, n));
    shared.sum(rows.data(), per_grain);
    for (std::size_t g = 0; g < ids.size(); ++g)
        for (int n = 0; n < per_grain; ++n)
            EXPECT_EQ(rows[g * per_grain + n], expected_sum(group.size(), ids[g], n));
}

TEST(SharedGrains, EveryHolderGetsTheSameSum) {
    const RankGroup group(MPI_COMM_WORLD);
    SharedGrains shared(group);
    const std::vector<GrainId> ids = grains_of(group.rank());
    shared.hold(ids.data(), static_cast<int>(ids.size()));
    expect_sums(shared, group, ids, 3);
    expect_sums(shared, group, ids, 7);
}

TEST(SharedGrains, FollowsGrainsThatComeAndGo) {
    const RankGroup group(MPI_COMM_WORLD);
    SharedGrains shared(group);
    const std::vector<GrainId> ids = grains_of(group.rank());
    shared.hold(ids.data(), static_cast<int>(ids.size()));
    shared.hold(ids.data(), group.rank() == 0 ? 0 : static_cast<int>(ids.size()));
    if (group.rank() != 0) {
        std::vector<double> rows(ids.size(), 1.0);
        shared.sum(rows.data(), 1);
        for (std::size_t g = 0; g < ids.size(); ++g) {
            double holders = 0.0;
            for (int rank = 1; rank < group.size(); ++rank) holders += holds(rank, ids[g]);
            EXPECT_EQ(rows[g], holders);
        }
    } else {
        shared.sum(nullptr, 1);
    }
    shared.hold(ids.data(), static_cast<int>(ids.size()));
    expect_sums(shared, group, ids, 2);
}

}  // namespace
}  // namespace turbidite
