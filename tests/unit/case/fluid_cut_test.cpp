// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How the layers of the fluid's cells are shared out among its ranks.
#include "launcher/case/fluid_cut.hpp"

#include <iterator>
#include <numbers>
#include <numeric>
#include <sstream>

#include "tests/unit/case/case_test.hpp"

namespace turbidite {
namespace {

TEST(FluidCut, PartsHaveTheSameWeightAndAllLayers) {
    EXPECT_EQ(cut_evenly(std::vector<double>(12, 1.0), 3, 1), (std::vector<int>{4, 4, 4}));
    EXPECT_EQ(cut_evenly(std::vector<double>(11, 2.0), 2, 1), (std::vector<int>{5, 6}));
    // 4 layers of 4 weigh as much as the 16 above.
    std::vector<double> bed(20, 1.0);
    std::fill_n(bed.begin(), 4, 4.0);
    EXPECT_EQ(cut_evenly(bed, 2, 1), (std::vector<int>{4, 16}));
    EXPECT_EQ(cut_evenly(bed, 4, 1), (std::vector<int>{2, 2, 8, 8}));
}

TEST(FluidCut, EveryPartHasItsFewestLayers) {
    std::vector<double> top(16, 1.0), bottom(16, 1.0);
    top.back() = bottom.front() = 1000.0;
    EXPECT_EQ(cut_evenly(top, 4, 4), (std::vector<int>{4, 4, 4, 4}));
    EXPECT_EQ(cut_evenly(bottom, 4, 4), (std::vector<int>{4, 4, 4, 4}));
    EXPECT_EQ(cut_evenly(top, 3, 4), (std::vector<int>{8, 4, 4}));
    EXPECT_EQ(cut_evenly(bottom, 3, 4), (std::vector<int>{4, 4, 8}));
}

class CutCase : public CaseTest {
 protected:
    explicit CutCase(const std::string& beginning) : CaseTest(beginning) {}

    double grains() const { return static_cast<double>(load().population.size()); }

    std::vector<int> layers(const std::vector<std::string>& set) const {
        const Settings settings = load("", set).settings;
        if (!settings.has("run.fluid_layers")) return {};
        std::istringstream text(settings.text("run.fluid_layers"));
        return {std::istream_iterator<int>(text), {}};
    }
};

/// A bed of 10 x 10 D in the lower left corner of a box of 20 x 40 D at D/8.
class FluidCutInThePlane : public CutCase {
 protected:
    FluidCutInThePlane()
        : CutCase(
              "domain: {size: [20, 40]}\n"
              "grains: {generator: lattice, region: [10, 10], compacity: 0.85}\n"
              "fluid: {reynolds: 36, cells_per_diameter: 8}\n"
              "time: {step: 0.01, end: 1}\n") {}
};

// The bed lies in the lower part, whose covered cells are worth five. To a row of 160 cells.
TEST_F(FluidCutInThePlane, ARankWithABedHasFewerRows) {
    const std::vector<int> two = layers({"fluid.ranks=2"});
    ASSERT_EQ(two.size(), 2u);
    EXPECT_EQ(two[0] + two[1], 320);
    ASSERT_GT(two[0], 80) << "of the bed";
    EXPECT_NEAR(160.0 * (two[1] - two[0]), 4.0 * grains() * 0.25 * std::numbers::pi * 64.0, 160.0);
    EXPECT_GT(two[1] - two[0], 100);
    const std::vector<int> four = layers({"fluid.ranks=4"});
    EXPECT_EQ(std::accumulate(four.begin(), four.end(), 0), 320);
    EXPECT_LT(four[0], 50);
    EXPECT_NEAR(four[2], four[3], 1) << "fluid alone";
    EXPECT_NEAR(two[1], four[2] + four[3], 1);
}

TEST_F(FluidCutInThePlane, OnlyRanksWithRowsAreCut) {
    EXPECT_EQ(layers({"fluid.ranks=1"}), std::vector<int>{});
    EXPECT_EQ(layers({"fluid.ranks=2", "fluid.decomposition=columns"}), std::vector<int>{});
    EXPECT_EQ(layers({"fluid.ranks=2", "fluid.enabled=false"}), std::vector<int>{});
}

// Rows that grow above the bed have as many cells as any, and there are fewer of them.
TEST_F(FluidCutInThePlane, RowsMayGrow) {
    const std::vector<int> two =
        layers({"fluid.ranks=2", "fluid.stretch_from=15", "fluid.stretch_ratio=1.05"});
    ASSERT_EQ(two.size(), 2u);
    EXPECT_GT(two[0] + two[1], 130);
    EXPECT_LT(two[0] + two[1], 200);
    EXPECT_LT(two[0], 60);
}

class FluidCutInSpace : public CutCase {
 protected:
    FluidCutInSpace()
        : CutCase(
              "dimension: 3\n"
              "domain: {size: [6, 20, 6], left: cyclic, right: cyclic, front: cyclic, back: "
              "cyclic}\n"
              "grains: {generator: lattice, region: [6, 5, 6], compacity: 0.6}\n"
              "fluid: {reynolds: 36, cells_per_diameter: 8}\n"
              "time: {step: 0.01, end: 1}\n") {}
};

// To a layer of 48 x 48 cells.
TEST_F(FluidCutInSpace, ARankWithABedHasFewerLayers) {
    const std::vector<int> two = layers({"fluid.ranks=2"});
    ASSERT_EQ(two.size(), 2u);
    EXPECT_EQ(two[0] + two[1], 160);
    ASSERT_GT(two[0], 40) << "of the bed";
    EXPECT_NEAR(48.0 * 48.0 * (two[1] - two[0]), 1.5 * grains() * std::numbers::pi / 6.0 * 512.0,
                48.0 * 48.0);
    EXPECT_GT(two[1] - two[0], 20);
}

}  // namespace
}  // namespace turbidite
