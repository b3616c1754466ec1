// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/plane/profile_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

namespace turbidite {
namespace {

/// Random, diagonally dominant, row i zero left of first[i].
Eigen::MatrixXd random_matrix(const std::vector<int>& first, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    const int n = static_cast<int>(first.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i < n; ++i)
        for (int j = first[i]; j < i; ++j) matrix(i, j) = matrix(j, i) = value(random);
    matrix.diagonal().setConstant(n);
    return matrix;
}

void add(ProfileCholesky& factors, const Eigen::MatrixXd& matrix, const std::vector<int>& first) {
    factors.begin_matrix();
    for (int i = 0; i < matrix.rows(); ++i) {
        double* row = factors.add_row(first[i]);
        for (int j = first[i]; j <= i; ++j) row[j - first[i]] = matrix(i, j);
    }
    ASSERT_TRUE(factors.factorise());
}

TEST(ProfileCholesky, SolvesEachOfManyMatrices) {
    const std::vector<std::vector<int>> profiles = {
        {0}, {0, 0, 1, 0, 3, 2}, {0, 1, 2, 3}, {0, 0, 0, 0, 0}};
    ProfileCholesky factors;
    std::vector<Eigen::MatrixXd> matrices;
    for (const auto& profile : profiles) {
        matrices.push_back(random_matrix(profile, 7 + static_cast<unsigned>(matrices.size())));
        add(factors, matrices.back(), profile);
    }
    for (int m = 0; m < static_cast<int>(matrices.size()); ++m) {
        using Rows = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
        const Rows wanted = Rows::Random(matrices[m].rows(), 2);
        Rows x = matrices[m] * wanted;
        factors.solve<2>(m, x.data());
        EXPECT_LT((x - wanted).norm(), 1e-13) << "matrix " << m;
        EXPECT_EQ(factors.size(m), matrices[m].rows());
    }
}

TEST(ProfileCholesky, IsReusedAfterClear) {
    ProfileCholesky factors;
    add(factors, random_matrix({0, 0, 0}, 1), {0, 0, 0});
    factors.clear();
    const std::vector<int> first = {0, 0};
    const Eigen::MatrixXd matrix = random_matrix(first, 2);
    add(factors, matrix, first);
    Eigen::Vector2d x = matrix * Eigen::Vector2d(0.3, -0.7);
    factors.solve<1>(0, x.data());
    EXPECT_LT((x - Eigen::Vector2d(0.3, -0.7)).norm(), 1e-14);
}

TEST(ProfileCholesky, RefusesASingularMatrix) {
    ProfileCholesky factors;
    factors.begin_matrix();
    *factors.add_row(0) = 1.0;
    double* row = factors.add_row(0);
    row[0] = row[1] = 1.0;
    EXPECT_FALSE(factors.factorise());
}

}  // namespace
}  // namespace turbidite
