// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The forecast of the files of a run: how it grows with the case, and what is said when the disk is
// too small. tests/system/disk_forecast_test.cpp compares it with the files of a run.
#include "launcher/case/forecast/disk_cost.hpp"

#include "tests/unit/case/case_test.hpp"

namespace turbidite {
namespace {

constexpr double cells = 192.0 * 192.0;

class DiskCost : public CaseTest {
 protected:
    // 192 x 192 cells and 15 discs; 20 outputs, one checkpoint after 10 t_c.
    DiskCost()
        : CaseTest(
              "domain: {size: [12, 12]}\n"
              "grains: {adapter: yade-nscd, count: 15}\n"
              "fluid: {reynolds: 30, cells_per_diameter: 16}\n"
              "time: {step: 0.01, end: 10}\n"
              "output: {interval: 0.5}\n"
              "checkpoint: {interval: 10, wall_minutes: 0}\n") {}

    double bytes(const std::vector<std::string>& overrides = {}) const {
        return 1e9 * predicted_disk(load("", overrides));
    }
};

TEST_F(DiskCost, GrowsWithCellsAndOutputTimes) {
    const double usual = bytes();
    EXPECT_GT(usual, 20.0 * 56.0 * cells) << "velocity, multipliers and pressure, 20 times";
    EXPECT_NEAR(usual - bytes({"output.fields_interval=5"}), 18.0 * 56.0 * cells, 1.0);
    EXPECT_NEAR(bytes({"output.fields=vorticity solid"}) - usual, 20.0 * 16.0 * cells, 1.0);
    EXPECT_NEAR(bytes({"fluid.cells_per_diameter=32"}) / usual, 4.0, 0.1);
    EXPECT_GT(bytes({"fluid.ranks=2"}), usual + 100.0 * cells) << "the mesh of every rank";
}

TEST_F(DiskCost, CountsTheLastWindowAndCheckpointsThatAreKept) {
    const double set = 84.0 * cells + 900.0 * 15.0, none = bytes({"checkpoint.interval=0"});
    const double two = bytes();
    EXPECT_NEAR(two - none, 2.0 * set, 1.0) << "of the beginning and of the end";
    EXPECT_DOUBLE_EQ(bytes({"checkpoint.interval=1"}), two) << "keep is 2";
    EXPECT_NEAR(bytes({"checkpoint.interval=4", "checkpoint.keep=9"}) - none, 4.0 * set, 1.0);
    EXPECT_DOUBLE_EQ(bytes({"checkpoint.windows=100", "checkpoint.interval=0"}), two);
    EXPECT_GT(bytes({"output.fields_interval=7.5"}), bytes({"output.fields_interval=10"}));
}

/// Of one cell; the sizes of the files of states. Those of a box program in space are 56.2 and
/// 112.4, with a layer more of faces than of cells.
TEST_F(DiskCost, ACheckpointHasWhatStepsRemember) {
    const auto per_cell = [this](std::vector<std::string> set, double count) {
        set.emplace_back("checkpoint.keep=1");
        const double with = bytes(set);
        set.emplace_back("checkpoint.interval=0");
        return (with - bytes(set) - 900.0 * 15.0) / count;
    };
    const std::string first = "fluid.time_scheme=first-order",
                      rigid = "fluid.splitting=explicit-multiplier";
    EXPECT_NEAR(per_cell({first}, cells), 52.0, 0.1);
    EXPECT_NEAR(per_cell({rigid}, cells), 92.0, 0.1);
    const auto in_space = [&](std::vector<std::string> set) {
        for (const char* more : {"dimension=3", "domain.size=[6, 6, 6]",
                                 "fluid.cells_per_diameter=8", "grains.adapter=standalone-nscd"})
            set.emplace_back(more);
        return per_cell(set, 48.0 * 48.0 * 48.0);
    };
    const std::string box = "fluid.program=box", openfoam = "fluid.program=openfoam";
    EXPECT_NEAR(in_space({box, first}), 56.0, 0.1);
    EXPECT_NEAR(in_space({box}), 104.0, 0.1);
    EXPECT_NEAR(in_space({box, rigid}), 112.0, 0.1);
    EXPECT_NEAR(in_space({openfoam, rigid}), 116.0, 0.1);
}

TEST_F(DiskCost, DryRunsWriteGrainsAlone) {
    const double dry = bytes({"fluid.enabled=false"});
    EXPECT_GT(dry, 0.0);
    EXPECT_LT(dry, 0.05 * bytes());
    EXPECT_GT(bytes({"fluid.enabled=false", "grains.count=30"}), 1.5 * dry);
    EXPECT_GT(bytes({"fluid.enabled=false", "grains.shape=triangle"}), dry);
}

TEST_F(DiskCost, SaysThatTheDiskIsTooSmall) {
    const auto here = std::filesystem::temp_directory_path();
    const std::string text = lack_of_disk(1e12, here / "not/there/yet");
    EXPECT_SAYS(text, "roughly 1000000000000 GB of files are to come, ");
    EXPECT_SAYS(text, " are free in " + here.string() + ". A longer output.fields_interval");
    EXPECT_EQ(lack_of_disk(1e-9, here), "");
}

TEST_F(DiskCost, SizesAreToldAsPeopleSayThem) {
    EXPECT_EQ(rough_size(1e-9), "1 MB");
    EXPECT_EQ(rough_size(0.0254), "25 MB");
    EXPECT_EQ(rough_size(1.74), "1.7 GB");
    EXPECT_EQ(rough_size(52.3), "52 GB");
}

}  // namespace
}  // namespace turbidite
