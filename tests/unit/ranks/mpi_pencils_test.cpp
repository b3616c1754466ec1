// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Separable solves on several ranks against the solve on one rank.
#include "fluid_adapter/ranks/mpi_pencils.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fluid_adapter/ranks/cell_rows.hpp"
#include "tests/unit/linear_solvers/dense_laplacian.hpp"
#include "tests/unit/ranks/decompositions.hpp"

namespace turbidite {
namespace {

double some_value(int cell) {
    return std::sin(3.7 * cell * cell + 1.0) + 0.3;
}

struct Solved {
    std::vector<double> values;
    double mean;
};

Solved on_one_rank(const SeparableOperator& plane, const Helmholtz& problem) {
    SeparableSolve solve(plane);
    solve.factorise(problem);
    const int cells = plane.layer() * plane.y.cells;
    for (int c = 0; c < cells; ++c) solve.values()[c] = some_value(c);
    const double mean = solve.solve();
    return {{solve.values(), solve.values() + cells}, mean};
}

void expect_equal_on_all_ranks(const SeparableOperator& plane, const Helmholtz& problem,
                               const Decomposition& decomposition) {
    SCOPED_TRACE(decomposition.name);
    const RankGroup group(MPI_COMM_WORLD);
    const int nx = plane.layer(), ny = plane.y.cells;
    const std::vector<int> cells =
        cells_of(decomposition, nx, ny, group.rank(), group.size(), decomposition.name == "random");
    CellRows rows(group, nx, ny, cells);
    SeparableSolve solve(plane, rows.pencils());
    solve.factorise(problem);
    rows.gather([&](int c) { return some_value(cells[c]); }, solve.values());
    const double mean = solve.solve();

    const Solved expected = on_one_rank(plane, problem);
    // The eliminations are the same for each mode. The difference is FFTW's order of additions,
    // which may depend on the number of rows of a plan.
    rows.scatter(solve.values(), [&](int c, double value) {
        EXPECT_NEAR(value, expected.values[cells[c]], 1e-13);
    });
    EXPECT_NEAR(mean, expected.mean, 1e-14);
    EXPECT_NEAR(rows.first(solve.values()), expected.values[0], 1e-13);
}

TEST(MpiPencils, SolveBoxesAsOneRankDoes) {
    for (const Ends& z : all_ends())
        for (const Decomposition& decomposition : all_decompositions())
            for (const double alpha : {0.0, 1.0})
                expect_equal_on_all_ranks({axis_of(5, 0.25, all_ends()[0]),
                                           axis_of(12, 0.4, all_ends()[4]), axis_of(3, 0.3, z)},
                                          {alpha, 0.02}, decomposition);
}

TEST(MpiPencils, SolveAsOneRankDoesForEveryPairOfEnds) {
    for (const Ends& x : all_ends())
        for (const Ends& y : all_ends())
            for (const Helmholtz& problem : {Helmholtz{1.0, 0.02}, {0.0, 0.7}})
                for (const Decomposition& decomposition : all_decompositions())
                    expect_equal_on_all_ranks({axis_of(12, 0.25, x), axis_of(9, 0.4, y)}, problem,
                                              decomposition);
}

/// Fewer rows or modes than ranks: some ranks have none.
TEST(MpiPencils, RanksMayBeLeftWithoutRowsOrModes) {
    const Ends closed = {End::neumann, End::neumann};
    for (const Decomposition& decomposition : all_decompositions())
        expect_equal_on_all_ranks({axis_of(3, 0.25, closed), axis_of(3, 0.4, closed)}, {0.0, 1.0},
                                  decomposition);
}

/// By messages, as between nodes, and by shared memory; repeated, so that a rank that runs ahead of
/// the others would be detected.
TEST(MpiPencils, TransposeThereAndBackIsExact) {
    const RankGroup group(MPI_COMM_WORLD);
    const std::vector<Span> rows = even_spans(11, group.size());
    const Span& own = rows[group.rank()];
    for (const bool shared_memory : {false, true}) {
        MpiPencils pencils(group, 7, rows, shared_memory);
        for (int round = 0; round < 200; ++round) {
            for (int k = 0; k < 7 * own.count; ++k) pencils.rows()[k] = round + 7 * own.first + k;
            pencils.to_columns();
            for (int j = 0; j < 11; ++j)
                for (int m = 0; m < pencils.mode_count(); ++m) {
                    double& value = pencils.columns()[j * pencils.mode_count() + m];
                    ASSERT_EQ(value, round + 7 * j + pencils.first_mode() + m);
                    value += 0.5;
                }
            pencils.to_rows();
            for (int k = 0; k < 7 * own.count; ++k)
                ASSERT_EQ(pencils.rows()[k], round + 7 * own.first + k + 0.5);
        }
    }
}

/// The room that is missing on one rank alone is missing for all.
TEST(SharedValues, FitIfTheLeastFreeSpaceHoldsThoseOfAllRanks) {
    const RankGroup group(MPI_COMM_WORLD);
    const double bytes = 8e6 * group.size();
    EXPECT_TRUE(SharedValues::fits(group, 1000000, 2.0 * bytes));
    EXPECT_FALSE(SharedValues::fits(group, 1000000, bytes));
    const bool last = group.rank() + 1 == group.size();
    EXPECT_FALSE(SharedValues::fits(group, 1000000, last ? 1e6 : 1e12));
    EXPECT_GT(free_shared_memory(), 0.0);
}

/// A rank that fails tells so, whatever the others wait for: it does not wait for them to free the
/// memory.
TEST(SharedValues, ARankThatFailsDoesNotWaitForTheOthers) {
    const RankGroup group(MPI_COMM_WORLD);
    int failed = 0;
    try {
        const SharedValues values(group, 10);
        if (group.rank() > 0) MPI_Bcast(&failed, 1, MPI_INT, 0, group.comm());
        throw std::runtime_error("the other ranks hear of it");
    } catch (const std::runtime_error&) {
        failed = 1;
        if (group.rank() == 0) MPI_Bcast(&failed, 1, MPI_INT, 0, group.comm());
    }
    EXPECT_EQ(failed, 1);
}

}  // namespace
}  // namespace turbidite
