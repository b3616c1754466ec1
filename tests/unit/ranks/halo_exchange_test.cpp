// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/ranks/halo_exchange.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "fluid_adapter/ranks/local_block.hpp"
#include "tests/unit/ranks/decompositions.hpp"

namespace turbidite {
namespace {

constexpr int nx = 13, ny = 11, layers = 2;

CellGrid grid_with(Side along_x, Side along_y) {
    CellGrid grid;
    grid.counts = {nx, ny, 1};
    grid.spacing = {1.0, 1.0, 1.0};
    grid.sides[0] = {along_x, along_x};
    grid.sides[1] = {along_y, along_y};
    return grid;
}

int apart(int a, int b, int n, bool cyclic) {
    const int distance = std::abs(a - b);
    return cyclic ? std::min(distance, n - distance) : distance;
}

/// By brute force: compares every cell with every own cell.
std::set<int> halo_by_force(const CellGrid& grid, const std::vector<int>& own) {
    std::set<int> halo;
    for (int cell = 0; cell < nx * ny; ++cell)
        for (const int mine : own)
            if (apart(cell % nx, mine % nx, nx, grid.cyclic(0)) <= layers &&
                apart(cell / nx, mine / nx, ny, grid.cyclic(1)) <= layers)
                halo.insert(cell);
    for (const int mine : own) halo.erase(mine);
    return halo;
}

struct Local {
    Local(const RankGroup& group, const CellGrid& grid, std::vector<int> own_cells)
        : own(std::move(own_cells)),
          block(grid, own, layers),
          halo(group, nx * ny, own, block.halo()) {
        block.number_halo(halo.halo());
        number = own;
        number.insert(number.end(), halo.halo().begin(), halo.halo().end());
    }
    std::vector<int> own;
    LocalBlock block;
    HaloExchange halo;
    std::vector<int> number;  // of each local cell
};

/// Runs `check(group, grid, local)` for all grids and decompositions.
template <class Check>
void everywhere(Check check) {
    const RankGroup group(MPI_COMM_WORLD);
    for (const Side x : {Side::wall, Side::cyclic})
        for (const Side y : {Side::wall, Side::cyclic})
            for (const Decomposition& decomposition : all_decompositions()) {
                SCOPED_TRACE(decomposition.name);
                const CellGrid grid = grid_with(x, y);
                Local local(group, grid,
                            cells_of(decomposition, nx, ny, group.rank(), group.size(), true));
                check(group, grid, local);
            }
}

TEST(LocalBlock, KnowsOwnCellsAndTheLayersAround) {
    everywhere([](const RankGroup&, const CellGrid& grid, const Local& local) {
        const std::set<int> halo(local.halo.halo().begin(), local.halo.halo().end());
        EXPECT_EQ(halo, halo_by_force(grid, local.own));
        std::vector<int> expected(nx * ny, -1);
        for (std::size_t c = 0; c < local.number.size(); ++c)
            expected[local.number[c]] = static_cast<int>(c);
        for (int cell = 0; cell < nx * ny; ++cell)
            EXPECT_EQ(local.block.at(cell % nx, cell / nx), expected[cell]);
    });
}

TEST(HaloExchange, ImportBringsTheOwnersValuesOfSeveralFields) {
    everywhere([](const RankGroup&, const CellGrid&, Local& local) {
        std::vector<double> a(local.number.size(), -1.0), b = a;
        for (std::size_t c = 0; c < local.own.size(); ++c) {
            a[c] = local.own[c];
            b[c] = 1000.0 + local.own[c];
        }
        local.halo.import({a.data(), b.data()});
        for (std::size_t c = 0; c < local.number.size(); ++c) {
            EXPECT_EQ(a[c], local.number[c]);
            EXPECT_EQ(b[c], 1000.0 + local.number[c]);
        }
    });
}

/// Export is the transpose of import: <import a, b> = <a, export b>, here with integers and so
/// exactly.
TEST(HaloExchange, ExportIsTheTransposeOfImport) {
    everywhere([](const RankGroup& group, const CellGrid&, Local& local) {
        const std::size_t n = local.number.size();
        std::vector<double> a(n, 0.0), b(n);
        for (std::size_t c = 0; c < local.own.size(); ++c) a[c] = local.own[c] % 7 + 1;
        for (std::size_t c = 0; c < n; ++c) b[c] = (local.number[c] + 3 * group.rank()) % 5;
        std::vector<double> twice(n, 0.0), b_twice(n);
        for (std::size_t c = 0; c < n; ++c) twice[c] = 2.0 * a[c];
        for (std::size_t c = 0; c < n; ++c) b_twice[c] = 3.0 * b[c];
        std::vector<double> imported = a, exported = b;
        local.halo.import({imported.data(), twice.data()});
        local.halo.export_sums({exported.data(), b_twice.data()});
        double dots[4] = {};
        for (std::size_t c = 0; c < n; ++c) {
            dots[0] += imported[c] * b[c];
            dots[2] += 3.0 * twice[c] * b[c];
        }
        for (std::size_t c = 0; c < local.own.size(); ++c) {
            dots[1] += a[c] * exported[c];
            dots[3] += 2.0 * a[c] * b_twice[c];
        }
        group.sum(dots, 4);
        EXPECT_EQ(dots[0], dots[1]);
        EXPECT_EQ(dots[2], dots[3]);
    });
}

TEST(HaloExchange, OwnCellsAndHaloMayLieApart) {
    everywhere([](const RankGroup&, const CellGrid&, Local& local) {
        const std::size_t own = local.own.size();
        std::vector<double> a(local.own.begin(), local.own.end()), b(own, 5.0);
        std::vector<double> beyond(local.number.size() - own), b_beyond(beyond.size());
        local.halo.import({a.data(), b.data()}, {beyond.data(), b_beyond.data()});
        for (std::size_t c = 0; c < beyond.size(); ++c) {
            EXPECT_EQ(beyond[c], local.number[own + c]);
            EXPECT_EQ(b_beyond[c], 5.0);
        }
    });
}

TEST(HaloExchange, ACellWithoutOwnerIsRefusedOnEveryRank) {
    const RankGroup group(MPI_COMM_WORLD);
    const std::vector<int> own = {group.rank()};
    const std::vector<int> halo = {group.rank() == 0 ? nx * ny - 1 : 0};
    EXPECT_THROW(HaloExchange(group, nx * ny, own, halo), std::invalid_argument);
}

}  // namespace
}  // namespace turbidite
