// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The direct solve with rows of different heights, against dense solves of the finite-volume
// Laplacian on the same cells.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <stdexcept>

#include "fluid_adapter/linear_solvers/elimination_factors.hpp"
#include "tests/unit/linear_solvers/dense_laplacian.hpp"

namespace turbidite {
namespace {

constexpr double h = 0.25;

/// Equal rows, then rows that grow by a tenth each.
std::vector<double> growing(int rows, int equal) {
    std::vector<double> sizes;
    for (int j = 0; j < rows; ++j)
        sizes.push_back(j < equal ? h : 1.1 * (j == 0 ? h : sizes.back()));
    return sizes;
}

std::vector<double> irregular(int rows) {
    std::vector<double> sizes;
    for (int j = 0; j < rows; ++j) sizes.push_back(h * (1.3 + std::sin(2.1 * j)));
    return sizes;
}

std::vector<SeparableOperator> stretched_planes() {
    std::vector<SeparableOperator> planes;
    for (const Ends& x : all_ends())
        for (const Ends& y : all_ends()) {
            if (y[0] == End::periodic) continue;
            for (const std::vector<double>& sizes :
                 {growing(9, 4), growing(8, 0), irregular(7), irregular(3)}) {
                AxisOperator rows = axis_of(static_cast<int>(sizes.size()), h, y);
                rows.sizes = sizes;
                planes.push_back({axis_of(6, h, x), rows});
            }
        }
    return planes;
}

Eigen::VectorXd some_values(const SeparableOperator& plane) {
    Eigen::VectorXd f(plane.x.cells * plane.y.cells);
    for (int i = 0; i < f.size(); ++i) f[i] = std::sin(3.7 * i * i + 1.0) + 0.3;
    return f;
}

/// Heights of the rows, for every cell.
Eigen::VectorXd heights(const SeparableOperator& plane) {
    Eigen::VectorXd all(plane.x.cells * plane.y.cells);
    for (int c = 0; c < all.size(); ++c) all[c] = plane.y.sizes[c / plane.x.cells];
    return all;
}

bool singular(const SeparableOperator& plane) {
    return plane.x.has_zero_mode() && plane.y.has_zero_mode();
}

TEST(StretchedRows, EqualADenseSolve) {
    int seen = 0;
    for (const SeparableOperator& plane : stretched_planes()) {
        SeparableSolve solve(plane);
        const Eigen::MatrixXd L = dense_grid(plane);
        const Eigen::VectorXd f = some_values(plane);
        for (const Helmholtz& problem : {Helmholtz{1.0, 0.02}, {3.0, 50.0}, {0.0, 0.7}}) {
            if (problem.alpha == 0.0 && singular(plane)) continue;
            ++seen;
            solve.factorise(problem);
            Eigen::Map<Eigen::VectorXd> x(solve.values(), f.size());
            x = f;
            solve.solve();
            const Eigen::MatrixXd A =
                problem.alpha * Eigen::MatrixXd::Identity(f.size(), f.size()) + problem.beta * L;
            const Eigen::VectorXd expected = A.partialPivLu().solve(f);
            EXPECT_LT((x - expected).norm(), 1e-12 * expected.norm());
        }
    }
    EXPECT_GT(seen, 200);
}

/// The mean over the volume is taken off f, and the solution's is zero.
TEST(StretchedRows, FreeConstantsAreThoseOfTheVolume) {
    int seen = 0;
    for (const SeparableOperator& plane : stretched_planes()) {
        if (!singular(plane)) continue;
        ++seen;
        SeparableSolve solve(plane);
        solve.factorise({0.0, 0.7});
        const Eigen::VectorXd volume = heights(plane) / heights(plane).sum();
        Eigen::VectorXd g = some_values(plane);
        g.array() -= volume.dot(g);
        Eigen::Map<Eigen::VectorXd> x(solve.values(), g.size());
        x = g.array() + 5.0;
        EXPECT_NEAR(solve.solve(), 5.0, 1e-13);
        EXPECT_NEAR(volume.dot(x), 0.0, 1e-13);
        EXPECT_LT((0.7 * dense_grid(plane) * x - g).norm(), 1e-12 * g.norm());
    }
    EXPECT_EQ(seen, 8);
}

TEST(StretchedRows, OfTheReferenceHeightAreEqualRows) {
    SeparableOperator equal{axis_of(12, h, {End::neumann, End::neumann}),
                            axis_of(40, h, {End::dirichlet, End::neumann})};
    SeparableOperator stretched = equal;
    stretched.y.sizes.assign(40, h);
    SeparableSolve one(equal), other(stretched);
    const Eigen::VectorXd f = some_values(equal);
    for (SeparableSolve* solve : {&one, &other}) {
        solve->factorise({1.0, 0.3});
        Eigen::Map<Eigen::VectorXd>(solve->values(), f.size()) = f;
        solve->solve();
    }
    for (int c = 0; c < f.size(); ++c) EXPECT_NEAR(one.values()[c], other.values()[c], 1e-14);
}

/// Factors settle in the equal rows below and above a stretched part, and only there.
TEST(StretchedRows, StoreTheirFactorsAndEqualRowsDoNot) {
    constexpr int modes = 320, rows = 960, stretched = 60;
    std::vector<double> shift;
    const AxisOperator x = axis_of(modes, 1.0, {End::periodic, End::periodic});
    for (int k = 0; k < modes; ++k) shift.push_back(x.eigenvalue(k) + 10.0);
    std::vector<EliminationRow> matrix(rows);
    for (int j = 400; j < 400 + stretched; ++j) matrix[j] = {1.2, 1.8, 0.9};
    EliminationFactors factors;
    factors.compute(shift, matrix);
    EXPECT_GT(factors.stored(), std::size_t{modes} * stretched);
    EXPECT_LT(factors.stored(), std::size_t{modes} * (stretched + 40));
    double e = 0.0, below = 0.0;
    for (int j = 0; j < rows; ++j) {
        e = 1.0 / (matrix[j].size * shift[7] + matrix[j].diagonal - below * below * e);
        below = matrix[j].above;
        factors.for_row(j, [&](int begin, int end, const double* stored) {
            if (begin <= 7 && 7 < end) {
                EXPECT_NEAR(stored[7 - begin], e, 1e-15);
            }
        });
    }
}

TEST(StretchedRows, ImpossibleAxesAreRefused) {
    AxisOperator axis = axis_of(4, h, {End::neumann, End::neumann});
    axis.sizes = {h, h, h};
    EXPECT_THROW(check(axis), std::invalid_argument);
    axis.sizes = {h, h, h, 0.0};
    EXPECT_THROW(check(axis), std::invalid_argument);
    axis.sizes = {h, h, h, 2.0 * h};
    EXPECT_NO_THROW(check(axis));
    EXPECT_THROW(SeparableSolve({axis, axis_of(4, h, {End::neumann, End::neumann})}),
                 std::invalid_argument);
    axis.lower = axis.upper = End::periodic;
    EXPECT_THROW(check(axis), std::invalid_argument);
}

}  // namespace
}  // namespace turbidite
