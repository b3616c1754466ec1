// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Covered shares of cells and values between cell centres, as written for output.
#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "fluid_adapter/multiplier/cell_stencil.hpp"
#include "fluid_adapter/multiplier/covered_share.hpp"
#include "tests/unit/multiplier/memory_field.hpp"

namespace turbidite {
namespace {

double covered_area(const MemoryField& field, const std::vector<ImmersedGrain>& grains) {
    const std::vector<double> shares = covered_share(field, grains);
    for (const double share : shares) EXPECT_LE(share, 1.0);
    return std::accumulate(shares.begin(), shares.end(), 0.0) / 256.0;  // h = 1/16
}

TEST(CoveredShare, AddsUpToTheAreaOfTheGrains) {
    const double disc_area = std::numbers::pi / 4.0;
    const MemoryField field(48, 48, Side::wall), cyclic(48, 48, Side::cyclic);
    EXPECT_NEAR(covered_area(field, {disc(1, 1.013, 1.009)}), disc_area, 2e-3);
    EXPECT_NEAR(covered_area(field, {disc(1, 1.0, 1.0), disc(2, 2.0, 2.0)}), 2 * disc_area, 4e-3);
    EXPECT_NEAR(covered_area(cyclic, {disc(1, 2.9, 0.1)}), disc_area, 2e-3);
    EXPECT_NEAR(covered_area(field, {disc(1, 0.0, 1.5)}), disc_area / 2.0, 2e-3);
    // Where grains overlap, a cell is covered once.
    EXPECT_NEAR(covered_area(field, {disc(1, 1.0, 1.0), disc(2, 1.0, 1.0)}), disc_area, 0.05);
}

TEST(CoveredShare, IsOneInsideAndZeroOutside) {
    const MemoryField field(48, 48, Side::wall);
    const std::vector<double> shares = covered_share(field, {disc(1, 1.0, 1.0)});
    EXPECT_EQ(shares[16 + 48 * 16], 1.0);
    EXPECT_EQ(shares[40 + 48 * 40], 0.0);
}

CellGrid box_of_cubes(int count, double edge) {
    CellGrid grid;
    grid.dimension = 3;
    grid.counts = {count, count, count};
    grid.spacing = {edge, edge, edge};
    return grid;
}

/// At D/8 two lines of a cell at 8 x 8 places are 1/64 D apart.
TEST(CoveredShare, LengthsAddUpToTheVolumeOfASphere) {
    const CellGrid grid = box_of_cubes(16, 0.125);
    const Eigen::Vector3d centre(1.013, 0.97, 1.04);
    for (const int along : {0, 1, 2}) {
        double volume = 0.0;
        for (int cell = 0; cell < 16 * 16 * 16; ++cell)
            for (int sample = 0; sample < 64; ++sample) {
                const double s = (sample % 8 + 0.5) / 8 - 0.5, t = (sample / 8 + 0.5) / 8 - 0.5;
                Vec3 place{};
                place[(along + 1) % 3] = s, place[(along + 2) % 3] = t;
                volume += covered_length(grid, centre, 0.5, along,
                                         {cell % 16, cell / 16 % 16, cell / 256}, place);
            }
        EXPECT_NEAR(volume / 64 / 512, std::numbers::pi / 6.0, 2e-4) << along;
    }
}

TEST(LinearStencil, IsExactForALinearFieldAwayFromSides) {
    const MemoryField field({0.0, 0.25, 0.5, 0.75, 1.0, 1.25}, {0.0, 0.5, 0.8, 1.0, 1.4, 2.0},
                            Side::wall);
    const auto linear = [](double x, double y) { return 1.0 + 2.0 * x - 3.0 * y; };
    double value = 0.0, weights = 0.0;
    for (const StencilEntry& at : linear_stencil(field.grid(), {0.9, 1.1, 0.0})) {
        value += at.weight * linear(field.grid().centre(0, at.i), field.grid().centre(1, at.j));
        weights += at.weight;
    }
    EXPECT_NEAR(value, linear(0.9, 1.1), 1e-14);
    EXPECT_NEAR(weights, 1.0, 1e-14);
}

TEST(LinearStencil, TakesTheNearestCentreAtAWallAndTheOtherSideOfACyclicBox) {
    const MemoryField field(8, 8, Side::wall, 0.25), cyclic(8, 8, Side::cyclic, 0.25);
    double at_corner = 0.0, across = 0.0;
    for (const StencilEntry& at : linear_stencil(field.grid(), {2.0, 0.0, 0.0}))
        if (at.i == 7 && at.j == 0) at_corner += at.weight;
    EXPECT_NEAR(at_corner, 1.0, 1e-14);
    for (const StencilEntry& at : linear_stencil(cyclic.grid(), {2.0, 0.0, 0.0}))
        if (at.i == 0 && at.j == 7) across += at.weight;
    EXPECT_NEAR(across, 0.25, 1e-14);
}

TEST(LinearStencil, HasEightCellsInSpace) {
    CellGrid grid;
    grid.dimension = 3;
    grid.counts = {6, 5, 4};
    grid.spacing = {0.5, 0.4, 0.3};
    grid.sides[2].fill(Side::cyclic);
    const auto linear = [](double x, double y, double z) { return 1.0 + 2.0 * x - 3.0 * y + z; };
    const auto stencil = linear_stencil(grid, {1.1, 0.9, 0.7});
    ASSERT_EQ(stencil.size(), 8u);
    double value = 0.0, weights = 0.0;
    for (const StencilEntry& at : stencil) {
        value +=
            at.weight * linear(grid.centre(0, at.i), grid.centre(1, at.j), grid.centre(2, at.k));
        weights += at.weight;
    }
    EXPECT_NEAR(value, linear(1.1, 0.9, 0.7), 1e-14);
    EXPECT_NEAR(weights, 1.0, 1e-14);
    double behind = 0.0;  // across the cyclic side
    for (const StencilEntry& at : linear_stencil(grid, {1.1, 0.9, 0.0}))
        if (at.k == 3) behind += at.weight;
    EXPECT_NEAR(behind, 0.5, 1e-14);
}

}  // namespace
}  // namespace turbidite
