// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/box_step/row_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace turbidite {
namespace {

constexpr int nx = 5, ny = 6;

/// Value of cell (i, j).
double value(int i, int j) {
    return 1.0 + i + 10.0 * j;
}

std::vector<double> some_field() {
    std::vector<double> field;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) field.push_back(value(i, j));
    return field;
}

/// The cell whose value index k of n cells takes, and the factor.
std::pair<int, double> image(int k, int n, End lower, End upper) {
    if (k >= 0 && k < n) return {k, 1.0};
    if (lower == End::periodic) return {(k + n) % n, 1.0};
    const End end = k < 0 ? lower : upper;
    return {k < 0 ? -1 - k : 2 * n - 1 - k, end == End::dirichlet ? -1.0 : 1.0};
}

TEST(RowReader, GivesImagesBeyondTheSides) {
    const std::pair<End, End> ends[] = {{End::neumann, End::dirichlet},
                                        {End::dirichlet, End::neumann},
                                        {End::periodic, End::periodic}};
    const std::vector<double> field = some_field();
    for (const auto& x : ends)
        for (const auto& y : ends) {
            const SeparableOperator plane{{nx, 1.0, x.first, x.second},
                                          {ny, 1.0, y.first, y.second}};
            AllRows rows(plane);
            RowReader reader(plane, rows);
            reader.begin(field.data());
            for (int j = -2; j < ny + 2; ++j)
                for (int i = -2; i < nx + 2; ++i) {
                    const auto [column, sign_x] = image(i, nx, x.first, x.second);
                    const auto [row, sign_y] = image(j, ny, y.first, y.second);
                    EXPECT_EQ(reader.row(j)[i], sign_x * sign_y * value(column, row));
                }
        }
}

/// The steps write row j after their stencils have read row j + 2.
TEST(RowReader, KeepsWhatIsOverwrittenBehindIt) {
    std::vector<double> field = some_field();
    const AxisOperator x{nx, 1.0, End::periodic, End::periodic};
    for (const End end : {End::neumann, End::periodic}) {
        field = some_field();
        const SeparableOperator plane{x, {ny, 1.0, end, end}};
        AllRows rows(plane);
        RowReader reader(plane, rows);
        reader.begin(field.data());
        for (int j = -1; j < ny; ++j) {
            const double* last = reader.row(j + 2);
            const int source = image(j + 2, ny, end, end).first;
            EXPECT_EQ(last[3], value(3, source));
            EXPECT_EQ(reader.row(j - 1)[3], value(3, image(j - 1, ny, end, end).first));
            if (j >= 0) std::fill_n(field.begin() + j * nx, nx, -1e9);
        }
    }
}

}  // namespace
}  // namespace turbidite
