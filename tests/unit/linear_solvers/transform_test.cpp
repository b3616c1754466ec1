// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Row transforms against the sums that define them, for two rows at once and for a single one.
#include "fluid_adapter/linear_solvers/transform.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace turbidite {
namespace {

using std::numbers::pi;

/// Weight of x_j in mode k, for rows of n.
using Weight = std::function<double(int j, int k, int n)>;

struct KindCase {
    End lower, upper;
    Weight weight;
};

const std::vector<KindCase>& kinds() {
    static const std::vector<KindCase> list = {
        {End::neumann, End::neumann,
         [](int j, int k, int n) { return 2 * std::cos(pi * (j + 0.5) * k / n); }},
        {End::dirichlet, End::dirichlet,
         [](int j, int k, int n) { return 2 * std::sin(pi * (j + 0.5) * (k + 1) / n); }},
        {End::neumann, End::dirichlet,
         [](int j, int k, int n) { return 2 * std::cos(pi * (j + 0.5) * (k + 0.5) / n); }},
        {End::dirichlet, End::neumann,
         [](int j, int k, int n) { return 2 * std::sin(pi * (j + 0.5) * (k + 0.5) / n); }},
        {End::periodic, End::periodic,
         [](int j, int k, int n) {
             return 2 * k <= n ? std::cos(2 * pi * j * k / n) : -std::sin(2 * pi * j * (n - k) / n);
         }},
    };
    return list;
}

std::vector<double> some_row(int n, double start) {
    std::vector<double> row(n);
    for (int j = 0; j < n; ++j) row[j] = std::sin(1.3 * j * j + start);
    return row;
}

std::vector<double> by_definition(const std::vector<double>& row, const Weight& weight) {
    const int n = static_cast<int>(row.size());
    std::vector<double> modes(n, 0.0);
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j) modes[k] += weight(j, k, n) * row[j];
    return modes;
}

// Sums of up to 13 terms up to 2, with angles up to 40 that are rounded too: 26 x 40 rounding
// errors.
constexpr double rounding = 26 * 40 * 2.2e-16;

void expect_equal(const std::vector<double>& row, const std::vector<double>& expected) {
    for (std::size_t j = 0; j < row.size(); ++j) EXPECT_NEAR(row[j], expected[j], rounding);
}

TEST(RowTransform, IsTheSumThatDefinesIt) {
    for (const KindCase& kind : kinds())
        for (const int n : {3, 4, 7, 12, 13}) {
            RowTransform transform({n, 1.0, kind.lower, kind.upper});
            std::vector<double> first = some_row(n, 0.4), second = some_row(n, 2.0), alone = first;
            transform.forward(first.data(), second.data());
            transform.forward(alone.data(), nullptr);
            expect_equal(first, by_definition(some_row(n, 0.4), kind.weight));
            expect_equal(second, by_definition(some_row(n, 2.0), kind.weight));
            expect_equal(alone, first);
        }
}

TEST(RowTransform, ThereAndBackMultipliesByTheNormalisation) {
    for (const KindCase& kind : kinds())
        for (const int n : {3, 4, 7, 12, 13}) {
            RowTransform transform({n, 1.0, kind.lower, kind.upper});
            std::vector<double> first = some_row(n, 0.4), second = some_row(n, 2.0), alone = first;
            transform.forward(first.data(), second.data());
            transform.backward(first.data(), second.data());
            transform.forward(alone.data(), nullptr);
            transform.backward(alone.data(), nullptr);
            for (auto* row : {&first, &second, &alone})
                for (double& value : *row) value /= transform.normalisation();
            expect_equal(first, some_row(n, 0.4));
            expect_equal(second, some_row(n, 2.0));
            expect_equal(alone, first);
        }
}

}  // namespace
}  // namespace turbidite
