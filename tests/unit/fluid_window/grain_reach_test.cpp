// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/domain/grain_reach.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/run_settings.hpp"

namespace turbidite {
namespace {

// D = 1 m, cells of 1/8 D.
Settings equal_rows() {
    Settings settings = run_settings();
    settings.set("fluid.cells_per_diameter", 8.0);
    settings.set("fluid.allow_coarse", false);
    settings.set("fluid.stretch_ratio", 1.0);
    settings.set("fluid.stretch_from", 5.0);
    settings.set("fluid.stretch_largest", 4.0);
    return settings;
}

Settings stretched_rows() {
    Settings settings = equal_rows();
    settings.set("fluid.stretch_ratio", 1.05);
    return settings;
}

/// How far a rank of [1, 4] x [2, 5] x [0, 1] looks beyond its part [cells].
double cells_beyond(const Settings& settings) {
    const Box box = with_reach({{1, 2, 0}, {4, 5, 1}}, settings);
    const double beyond = 1.0 - box.lower[0];
    EXPECT_DOUBLE_EQ(box.lower[1], 2.0 - beyond);
    EXPECT_DOUBLE_EQ(box.lower[2], -beyond);
    EXPECT_DOUBLE_EQ(box.upper[0], 4.0 + beyond);
    EXPECT_DOUBLE_EQ(box.upper[1], 5.0 + beyond);
    EXPECT_DOUBLE_EQ(box.upper[2], 1.0 + beyond);
    return 8.0 * beyond;
}

TEST(GrainReach, SevenCellsOfThoseThatGrainsReach) {
    EXPECT_DOUBLE_EQ(cells_beyond(equal_rows()), 7.0);
    EXPECT_NEAR(cells_beyond(stretched_rows()), 7.0 * std::pow(1.05, 3), 1e-12);
    Settings coarse = stretched_rows();
    coarse.set("fluid.allow_coarse", true);
    EXPECT_DOUBLE_EQ(cells_beyond(coarse), 28.0);
}

}  // namespace
}  // namespace turbidite
