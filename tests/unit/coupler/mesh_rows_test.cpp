// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/scene/mesh_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace turbidite {
namespace {

Settings stretched(double from, double ratio, double largest) {
    Settings settings;
    settings.set("fluid.cells_per_diameter", std::int64_t{8});
    settings.set("fluid.stretch_from", from);
    settings.set("fluid.stretch_ratio", ratio);
    settings.set("fluid.stretch_largest", largest);
    return settings;
}

double height_of(const MeshRows& rows) {
    return std::accumulate(rows.stretched.begin(), rows.stretched.end(), rows.equal_height());
}

TEST(MeshRows, AreEqualUnlessAsked) {
    for (const Settings& settings : {stretched(5.0, 1.0, 16.0), [] {
                                         Settings plain;
                                         plain.set("fluid.cells_per_diameter", std::int64_t{8});
                                         return plain;
                                     }()}) {
        EXPECT_FALSE(rows_are_stretched(settings));
        const MeshRows rows = *mesh_rows(settings, 10.0);
        EXPECT_EQ(rows.count(), 80);
        EXPECT_EQ(rows.height, 1.0 / 8.0);
        EXPECT_EQ(rows.largest(), rows.height);
    }
}

TEST(MeshRows, EndExactlyAtTheTop) {
    for (const double from : {2.0, 5.03, 20.0})
        for (const double ratio : {1.01, 1.05, 1.2})
            for (const double largest : {2.0, 16.0})
                for (const double top : {40.0, 61.7, 100.0}) {
                    const Settings settings = stretched(from, ratio, largest);
                    const MeshRows rows = *mesh_rows(settings, top);
                    EXPECT_NEAR(height_of(rows), top, 1e-12 * top);
                    EXPECT_GE(rows.equal_height(), from);
                    EXPECT_LT(rows.equal_height(), from + rows.height);
                    EXPECT_GE(rows.ratio, 1.0);
                    EXPECT_LE(rows.ratio, ratio);
                    EXPECT_LE(rows.largest(), largest / 8.0);
                    double below = rows.height;
                    for (const double height : rows.stretched) {
                        EXPECT_GE(height, below);
                        EXPECT_LE(height, rows.ratio * below * (1.0 + 1e-12));
                        below = height;
                    }
                }
}

/// With one row less the ratio that is allowed would not reach the top.
TEST(MeshRows, AreAsFewAsTheRatioAllows) {
    const MeshRows rows = *mesh_rows(stretched(55.0, 1.02, 16.0), 100.0);
    double reached = rows.equal_height(), height = rows.height;
    for (std::size_t k = 0; k + 1 < rows.stretched.size(); ++k)
        reached += height = std::min(1.02 * height, 2.0);
    EXPECT_LT(reached, 100.0);
    EXPECT_LT(rows.count(), 600);  // of 800 equal ones
}

TEST(MeshRows, NeedRoomToGrow) {
    const Settings settings = stretched(9.0, 1.05, 16.0);
    const double least = least_stretched_room(settings);
    EXPECT_FALSE(mesh_rows(settings, 9.0));
    EXPECT_FALSE(mesh_rows(settings, 8.0));
    EXPECT_FALSE(mesh_rows(settings, 9.2));
    for (const double more : {0.0, 0.01, 0.1, 1.0})
        EXPECT_TRUE(mesh_rows(settings, 9.0 + least + more)) << more;
}

TEST(MeshRows, OfAnyHeightAreCountedInTime) {
    for (const double top : {1e8, 1e300}) {
        EXPECT_FALSE(mesh_rows(stretched(24.0, 1.05, 16.0), top)) << top;
        EXPECT_FALSE(mesh_rows(stretched(0.5 * top, 1.05, 16.0), top)) << top;
    }
    // The sum of n such rows is not a row more than n.
    EXPECT_TRUE(std::isinf(least_stretched_room(stretched(5.0, 1.0 + 1e-15, 16.0))));
}

}  // namespace
}  // namespace turbidite
