// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <stdexcept>

#include "tests/unit/linear_solvers/dense_laplacian.hpp"

namespace turbidite {
namespace {

/// The eigenvalues are those of the matrix, compared in sorted order with the dense matrix's.
TEST(SeparableOperator, EigenvaluesAreThoseOfTheMatrix) {
    for (const Ends& ends : all_ends())
        for (int n : {3, 8, 13}) {
            const AxisOperator axis = axis_of(n, 0.3, ends);
            const Eigen::VectorXd expected =
                Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense_axis(axis)).eigenvalues();
            std::vector<double> found;
            for (int k = 0; k < n; ++k) found.push_back(axis.eigenvalue(k));
            std::sort(found.begin(), found.end());
            for (int k = 0; k < n; ++k) EXPECT_NEAR(found[k], expected[k], 1e-12 * 4.0 / 0.09);
        }
}

TEST(SeparableOperator, DiagonalIsThatOfTheMatrix) {
    for (const Ends& ends : all_ends()) {
        const AxisOperator axis = axis_of(5, 0.3, ends);
        const Eigen::MatrixXd L = dense_axis(axis);
        for (int j = 0; j < 5; ++j) EXPECT_NEAR(axis.diagonal(j), L(j, j), 1e-12);
        EXPECT_NEAR(-axis.coupling(), L(2, 3), 1e-12);
    }
}

/// Constants are in the kernel only if no end holds a value: mu_0 is then exactly zero, not just
/// small.
TEST(SeparableOperator, ConstantsAreFreeWithoutADirichletEnd) {
    for (const Ends& ends : all_ends()) {
        const bool held = ends[0] == End::dirichlet || ends[1] == End::dirichlet;
        EXPECT_EQ(axis_of(8, 0.3, ends).has_zero_mode(), !held);
        EXPECT_EQ(axis_of(8, 0.3, ends).eigenvalue(0) == 0.0, !held);
    }
}

TEST(SeparableOperator, ImpossibleAxesAreRefused) {
    EXPECT_THROW(check(axis_of(2, 0.3, {End::neumann, End::neumann})), std::invalid_argument);
    EXPECT_THROW(check(axis_of(8, 0.0, {End::neumann, End::neumann})), std::invalid_argument);
    EXPECT_THROW(check(axis_of(8, 0.3, {End::periodic, End::neumann})), std::invalid_argument);
    EXPECT_THROW(check(axis_of(8, 0.3, {End::dirichlet, End::periodic})), std::invalid_argument);
    EXPECT_NO_THROW(check(axis_of(3, 0.3, {End::periodic, End::periodic})));
}

}  // namespace
}  // namespace turbidite
