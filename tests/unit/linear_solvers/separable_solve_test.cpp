// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Every combination of ends on both axes against a dense solve of the same problem, on grids with
// even and odd counts and with cells that are not square.
#include "fluid_adapter/linear_solvers/separable_solve.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cfenv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/unit/linear_solvers/dense_laplacian.hpp"

namespace turbidite {
namespace {

std::vector<SeparableOperator> all_planes() {
    std::vector<SeparableOperator> planes;
    for (const Ends& x : all_ends())
        for (const Ends& y : all_ends())
            for (const auto& [nx, ny] : {std::array{6, 8}, {7, 5}, {3, 3}, {12, 9}})
                planes.push_back({axis_of(nx, 0.25, x), axis_of(ny, 0.4, y)});
    return planes;
}

/// Of an even and an odd number of rows per layer, so that layers are transformed in pairs or not,
/// with more columns than are copied together, and an odd number of them.
std::vector<SeparableOperator> all_boxes() {
    std::vector<SeparableOperator> boxes;
    for (const Ends& x : all_ends())
        for (const Ends& y : all_ends())
            for (const Ends& z : all_ends())
                for (const auto& [nx, ny, nz] : {std::array{4, 5, 4}, {9, 3, 3}})
                    boxes.push_back(
                        {axis_of(nx, 0.25, x), axis_of(ny, 0.4, y), axis_of(nz, 0.3, z)});
    return boxes;
}

std::vector<SeparableOperator> all_grids() {
    std::vector<SeparableOperator> grids = all_planes();
    for (const SeparableOperator& box : all_boxes()) grids.push_back(box);
    return grids;
}

/// Values without any order, scale or symmetry.
Eigen::VectorXd some_values(const SeparableOperator& plane) {
    Eigen::VectorXd f(plane.layer() * plane.y.cells);
    for (int i = 0; i < f.size(); ++i) f[i] = std::sin(3.7 * i * i + 1.0) + 0.3;
    return f;
}

Eigen::VectorXd solved(SeparableSolve& solve, const Eigen::VectorXd& f) {
    Eigen::Map<Eigen::VectorXd> values(solve.values(), f.size());
    values = f;
    solve.solve();
    return values;
}

TEST(SeparableSolve, EqualsADenseSolveForEveryPairOfEnds) {
    for (const SeparableOperator& plane : all_grids()) {
        SeparableSolve solve(plane);
        const Eigen::MatrixXd L = dense_grid(plane);
        const Eigen::VectorXd f = some_values(plane);
        for (const Helmholtz& problem : {Helmholtz{1.0, 0.02}, {3.0, 50.0}, {0.0, 0.7}}) {
            if (problem.alpha == 0.0 && plane.has_zero_mode()) continue;
            solve.factorise(problem);
            const Eigen::MatrixXd A =
                problem.alpha * Eigen::MatrixXd::Identity(f.size(), f.size()) + problem.beta * L;
            const Eigen::VectorXd expected = A.ldlt().solve(f);
            EXPECT_LT((solved(solve, f) - expected).norm(), 1e-12 * expected.norm());
        }
    }
}

/// f = g + 5 with g of zero mean: 5 is returned as the subtracted mean, and x is the zero-mean
/// solution for g, which is that of least norm.
TEST(SeparableSolve, FreeConstantsTakeTheMeanOffAndGiveZeroMean) {
    int seen = 0;
    for (const SeparableOperator& plane : all_grids()) {
        if (!plane.has_zero_mode()) continue;
        ++seen;
        SeparableSolve solve(plane);
        solve.factorise({0.0, 0.7});
        Eigen::VectorXd g = some_values(plane);
        g.array() -= g.mean();
        Eigen::Map<Eigen::VectorXd> x(solve.values(), g.size());
        x = g.array() + 5.0;
        EXPECT_NEAR(solve.solve(), 5.0, 1e-13);
        const Eigen::VectorXd expected =
            (0.7 * dense_grid(plane)).completeOrthogonalDecomposition().solve(g);
        EXPECT_LT((x - expected).norm(), 1e-12 * expected.norm());
        EXPECT_NEAR(x.mean(), 0.0, 1e-14);
    }
    EXPECT_EQ(seen, 4 * 4 + 8 * 2);  // neumann or periodic along every axis, four planes, two boxes
}

/// On a large grid the residual is rounding: eps |A| |x|, with a margin of 100.
TEST(SeparableSolve, LeavesARoundingResidualOnALargeGrid) {
    for (const Ends& x_ends : all_ends())
        for (const Ends& y_ends : all_ends()) {
            const SeparableOperator plane{axis_of(100, 0.25, x_ends), axis_of(200, 0.25, y_ends)};
            SeparableSolve solve(plane);
            solve.factorise({0.0, 1.0});
            Eigen::VectorXd f = some_values(plane);
            if (plane.has_zero_mode()) f.array() -= f.mean();
            const Eigen::VectorXd solution = solved(solve, f);
            const auto x = Eigen::Map<const Eigen::MatrixXd>(solution.data(), 100, 200);
            const Eigen::MatrixXd image =
                dense_axis(plane.x) * x + x * dense_axis(plane.y).transpose();
            const double residual = (Eigen::Map<const Eigen::VectorXd>(image.data(), f.size()) - f)
                                        .lpNorm<Eigen::Infinity>();
            const double scale = 8.0 / 0.0625 * solution.lpNorm<Eigen::Infinity>();
            EXPECT_LT(residual, 100.0 * std::numeric_limits<double>::epsilon() * scale);
        }
}

TEST(SeparableSolve, TheHundredthSolveIsAsGoodAsTheFirst) {
    // Rows are transformed in pairs, also the last of an odd number. What it leaves in the row that
    // stands in for the missing one must not return.
    for (const SeparableOperator& plane : all_grids()) {
        SeparableSolve solve(plane);
        solve.factorise({1.0, 0.02});
        const Eigen::VectorXd f = some_values(plane), first = solved(solve, f);
        Eigen::VectorXd last;
        for (int n = 0; n < 100; ++n) last = solved(solve, f);
        EXPECT_EQ(last, first);
    }
}

/// A second problem with the same plans, and then the first again, bit for bit.
TEST(SeparableSolve, CanBeFactorisedAgain) {
    const SeparableOperator plane{axis_of(7, 0.25, {End::neumann, End::neumann}),
                                  axis_of(6, 0.4, {End::periodic, End::periodic})};
    SeparableSolve solve(plane);
    const Eigen::VectorXd f = some_values(plane);
    solve.factorise({0.0, 1.0});
    const Eigen::VectorXd first = solved(solve, f);
    solve.factorise({1.0, 1.0});
    EXPECT_GT((solved(solve, f) - first).norm(), 1e-3 * first.norm());
    solve.factorise({0.0, 1.0});
    EXPECT_EQ(solved(solve, f), first);
}

TEST(SeparableSolve, RefusesWhatIsNotPositive) {
    SeparableSolve solve({axis_of(7, 0.25, {End::neumann, End::neumann}),
                          axis_of(6, 0.4, {End::neumann, End::neumann})});
    EXPECT_THROW(solve.factorise({-1.0, 1.0}), std::invalid_argument);
    EXPECT_THROW(solve.factorise({1.0, 0.0}), std::invalid_argument);
    EXPECT_THROW(solve.factorise({1.0, std::nan("")}), std::invalid_argument);
}

/// Stock OpenFOAM applications abort at the first division by zero.
TEST(SeparableSolve, FreeConstantsAreNoDivisionByZero) {
    for (const SeparableOperator& plane : all_grids()) {
        SeparableSolve solve(plane);
        std::feclearexcept(FE_ALL_EXCEPT);
        solve.factorise({0.0, 1.0});
        solved(solve, some_values(plane));
        EXPECT_FALSE(std::fetestexcept(FE_DIVBYZERO | FE_INVALID));
    }
}

}  // namespace
}  // namespace turbidite
