// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/measures/pore_volume.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "coupler/output/measures/delaunay.hpp"

namespace turbidite {
namespace {

constexpr double pi = std::numbers::pi;

SolidGrain disc(double x, double y, double radius = 0.5) {
    return {x, y, pi * radius * radius};
}

double pores(const std::vector<SolidGrain>& grains, Vec3 period = {}) {
    return pore_volume(grains, 1.0, period);
}

/// Rows of `columns` discs at spacing `a`, each row shifted by `shift` against the one below.
std::vector<SolidGrain> rows(int columns, int count, double a, double height, double shift) {
    std::vector<SolidGrain> grains;
    for (int row = 0; row < count; ++row)
        for (int k = 0; k < columns; ++k)
            grains.push_back(disc(a * k + (row % 2) * shift, height * row));
    return grains;
}

/// By the definition: every triple of grains whose circumscribed circle has a diameter of at most D
/// and contains no other centre.
double by_definition(const std::vector<SolidGrain>& g) {
    double total = 0.0;
    for (std::size_t a = 0; a < g.size(); ++a)
        for (std::size_t b = a + 1; b < g.size(); ++b)
            for (std::size_t c = b + 1; c < g.size(); ++c) {
                const double bx = g[b].x - g[a].x, by = g[b].y - g[a].y;
                const double cx = g[c].x - g[a].x, cy = g[c].y - g[a].y;
                const double d = 2.0 * (bx * cy - by * cx);
                if (d == 0.0) continue;
                const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
                const double ux = (cy * b2 - by * c2) / d, uy = (bx * c2 - cx * b2) / d;
                const double radius = std::hypot(ux, uy);
                if (radius > 1.0) continue;
                bool empty = true;
                for (std::size_t e = 0; e < g.size() && empty; ++e)
                    empty = e == a || e == b || e == c ||
                            std::hypot(g[e].x - g[a].x - ux, g[e].y - g[a].y - uy) > radius;
                if (!empty) continue;
                // Law of cosines for the angles.
                const double ab = std::sqrt(b2), ac = std::sqrt(c2),
                             bc = std::hypot(bx - cx, by - cy);
                const auto angle = [](double opposite, double s, double t) {
                    return std::acos((s * s + t * t - opposite * opposite) / (2.0 * s * t));
                };
                total += std::abs(d) / 4.0 -
                         (g[a].area * angle(bc, ab, ac) + g[b].area * angle(ac, ab, bc) +
                          g[c].area * angle(ab, ac, bc)) /
                             (2.0 * pi);
            }
    return total;
}

TEST(PoreVolume, TooFewOrInALineHaveNone) {
    EXPECT_EQ(pores({}), 0.0);
    EXPECT_EQ(pores({disc(3, 4)}), 0.0);
    EXPECT_EQ(pores({disc(3, 4), disc(4, 4)}), 0.0);
    EXPECT_EQ(pores({disc(0, 0), disc(1, 0), disc(2, 0), disc(3, 0)}), 0.0);
    EXPECT_EQ(pores({disc(0, 0), disc(0.9, 0.3), disc(1.8, 0.6), disc(2.7, 0.9)}), 0.0)
        << "in line but for rounding";
    EXPECT_EQ(pores({disc(1, 1), disc(1, 1), disc(1, 1)}), 0.0);
}

// Three touching discs: an equilateral triangle minus half a disc.
TEST(PoreVolume, OfThreeDiscs) {
    const double h = std::sqrt(3.0) / 2.0;
    EXPECT_NEAR(pores({disc(0, 0), disc(1, 0), disc(0.5, h)}), h / 2.0 - pi / 8.0, 1e-14);
    // The largest that counts, with sides sqrt(3), whose circumradius is D; and a larger one.
    const double a = std::sqrt(3.0);
    const auto wide = [&](double s) {
        return pores({disc(0, 0), disc(s * a, 0), disc(s * a / 2, s * a * h)});
    };
    EXPECT_NEAR(wide(1.0), h * a * a / 2.0 - pi / 8.0, 1e-14);
    EXPECT_EQ(wide(1.0 + 1e-6), 0.0);
}

// Perfect lattices: (columns - 1)(rows - 1) cells between the centres. Four centres on a circle
// have no unique triangulation.
TEST(PoreVolume, OfLattices) {
    EXPECT_NEAR(pores(rows(7, 5, 1.0, 1.0, 0.0)), 6 * 4 * (1.0 - pi / 4.0), 1e-12);
    const double h = std::sqrt(3.0) / 2.0;
    // Rows shifted by half a disc: 2 n - 2 triangles between two rows of n.
    EXPECT_NEAR(pores(rows(7, 2, 1.0, h, 0.5)), 12 * (h / 2.0 - pi / 8.0), 1e-12);
    // The loosest lattice of the paper: squares of side 1 standing on a corner. Between three rows
    // of six there are 5 whole squares and, at the edges, 11 halves.
    const double s = std::sqrt(2.0);
    const auto loose = rows(6, 3, s, s / 2, s / 2);
    EXPECT_NEAR(pores(loose), 21 * (0.5 - pi / 8.0), 1e-12);
}

TEST(PoreVolume, OfRandomPackingsIsTheDefinitions) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int packing = 0; packing < 20; ++packing) {
        std::vector<SolidGrain> grains;
        for (int k = 0; k < 45; ++k)  // two sizes, with holes
            grains.push_back(disc(7.0 * unit(random), 5.0 * unit(random), k % 2 ? 0.3 : 0.15));
        const double expected = by_definition(grains);
        EXPECT_GT(expected, 1.0);
        EXPECT_NEAR(pores(grains), expected, 1e-10);
        for (SolidGrain& grain : grains) grain.x += 1000.0;
        EXPECT_NEAR(pores(grains), expected, 1e-10);
    }
}

// The whole volume outside the grains, if the packing fills a periodic box.
TEST(PoreVolume, RespectsCyclicSides) {
    EXPECT_NEAR(pores(rows(4, 4, 1.0, 1.0, 0.0), {4, 4, 0}), 16.0 - 4.0 * pi, 1e-12);
    const double h = std::sqrt(3.0) / 2.0;
    EXPECT_NEAR(pores(rows(5, 3, 1.0, h, 0.5), {5, 0, 0}), 20 * (h / 2.0 - pi / 8.0), 1e-12);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> jitter(-0.2, 0.2);
    std::vector<SolidGrain> grains;
    for (const SolidGrain& grain : rows(6, 6, 1.0, 1.0, 0.0))
        grains.push_back(disc(grain.x + jitter(random), grain.y + jitter(random), 0.3));
    EXPECT_NEAR(pores(grains, {6, 6, 0}), 36.0 - 36 * pi * 0.09, 1e-11);
    // Some have gone round, several times.
    for (std::size_t k = 0; k < grains.size(); k += 3) grains[k].x -= 18.0, grains[k].y += 6.0;
    EXPECT_NEAR(pores(grains, {6, 6, 0}), 36.0 - 36 * pi * 0.09, 1e-11);
}

// Of grains larger than D their own diameter is the limit.
TEST(PoreVolume, OfLargeGrainsGrowsWithThem) {
    for (const double size : {1.8, 3.0}) {
        std::vector<SolidGrain> grains;
        for (const SolidGrain& grain : rows(6, 6, 1.0, 1.0, 0.0))
            grains.push_back(disc(size * grain.x, size * grain.y, 0.5 * size));
        EXPECT_NEAR(pores(grains), size * size * 25 * (1.0 - pi / 4.0), 1e-11);
        EXPECT_NEAR(pores(grains, {6 * size, 6 * size, 0}), size * size * 36 * (1.0 - pi / 4.0),
                    1e-11);
    }
    // A large one among small ones
    EXPECT_NEAR(pores({disc(0, 0, 1.2), disc(1.7, 0), disc(0.85, 1.5)}),
                by_definition({disc(0, 0, 1.2), disc(1.7, 0), disc(0.85, 1.5)}), 1e-12);
}

// Two heaps far apart: the space between them does not count as pores.
TEST(PoreVolume, LeavesOutOpenSpace) {
    auto grains = rows(3, 3, 1.0, 1.0, 0.0);
    const double one = pores(grains);
    for (const SolidGrain& grain : rows(3, 3, 1.0, 1.0, 0.0))
        grains.push_back(disc(grain.x + 6.0, grain.y + 0.1));
    EXPECT_NEAR(pores(grains), 2.0 * one, 1e-12);
}

TEST(Delaunay, PointsOnACircleAreOneCell) {
    const auto square = delaunay_cells({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
    ASSERT_EQ(square.size(), 1u);
    EXPECT_EQ(square[0].size(), 4u);
    EXPECT_EQ(delaunay_cells({{0, 0}, {10, 0}, {10, 10}, {0, 10}, {4, 5}}).size(), 4u);
    constexpr int far = 1 << 30;
    EXPECT_EQ(delaunay_cells({{-far, -far}, {far, -far}, {0, far}}).size(), 1u);
    EXPECT_TRUE(delaunay_cells({{0, 0}, {0, 0}, {1, 1}}).empty());
}

}  // namespace
}  // namespace turbidite
