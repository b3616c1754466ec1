// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/ranks/cell_rows.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/ranks/decompositions.hpp"

namespace turbidite {
namespace {

TEST(CellRows, WholeRowsStayWhereTheyAre) {
    const RankGroup group(MPI_COMM_WORLD);
    for (const Decomposition& decomposition : all_decompositions()) {
        const bool slabs = decomposition.name.find("slabs in y") == 0 ||
                           decomposition.name == "uneven slabs" ||
                           decomposition.name == "all on the last rank" || !group.parallel();
        const auto cells = cells_of(decomposition, 8, 8, group.rank(), group.size());
        const CellRows rows(group, 8, 8, cells);
        if (slabs || decomposition.name != "blocks") {
            EXPECT_EQ(rows.stays(), slabs) << decomposition.name;
        }
    }
}

TEST(CellRows, ThereAndBackIsTheIdentity) {
    const RankGroup group(MPI_COMM_WORLD);
    for (const Decomposition& decomposition : all_decompositions())
        for (const bool shuffled : {false, true}) {
            const auto cells = cells_of(decomposition, 10, 7, group.rank(), group.size(), shuffled);
            CellRows rows(group, 10, 7, cells);
            const auto pencils = rows.pencils();
            rows.gather([&](int c) { return cells[c] + 0.5; }, pencils->rows());
            for (int k = 1; k < 10 * pencils->row_count(); ++k)
                EXPECT_EQ(pencils->rows()[k], pencils->rows()[0] + k) << decomposition.name;
            std::size_t seen = 0;
            rows.scatter(pencils->rows(), [&](int c, double value) {
                EXPECT_EQ(value, cells[c] + 0.5) << decomposition.name;
                ++seen;
            });
            EXPECT_EQ(seen, cells.size());
            EXPECT_EQ(rows.first(pencils->rows()), 0.5);
        }
}

TEST(CellRows, MissingAndDoubledCellsAreRefusedOnEveryRank) {
    const RankGroup group(MPI_COMM_WORLD);
    const Decomposition& slabs = all_decompositions()[0];
    std::vector<int> missing = cells_of(slabs, 10, 7, group.rank(), group.size());
    std::vector<int> doubled = missing;
    if (group.rank() == 0) {
        missing.pop_back();
        doubled.back() = doubled.front();
    }
    EXPECT_THROW(CellRows(group, 10, 7, missing), std::invalid_argument);
    EXPECT_THROW(CellRows(group, 10, 7, doubled), std::invalid_argument);
}

}  // namespace
}  // namespace turbidite
