// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a fluid cannot carry: grains too light for the scheme or too small for the mesh, a mesh too
// large for the memory.
#include <gtest/gtest.h>

#include "tests/unit/case/case_test.hpp"

namespace turbidite {
namespace {

class FluidLimits : public CaseTest {
 protected:
    FluidLimits()
        : CaseTest(
              "domain: {size: [12, 24]}\n"
              "grains: {count: 20}\n"
              "fluid: {reynolds: 36}\n"
              "time: {step: 0.01, end: 1}\n") {}
};

TEST_F(FluidLimits, LightGrainsInAFluidNeedJoint) {
    EXPECT_EQ(refusal("", {"grains.density_ratio=0.5", "fluid.enabled=false"}), "");
    for (const char* ratio : {"grains.density_ratio=0.5", "grains.density_ratio=1"}) {
        EXPECT_SAYS(refusal("", {ratio, "coupling.scheme=split"}), "Use coupling.scheme: joint");
        EXPECT_EQ(refusal("", {ratio, "coupling.scheme=joint"}), "");
    }
    EXPECT_SAYS(refusal("", {"grains.density_ratio=0", "fluid.enabled=false"}),
                "grains.density_ratio = 0");
}

TEST_F(FluidLimits, ABalanceWarnsBeforeItEndsTheRun) {
    const std::string text = refusal("", {"limits.grain_balance_hard=1e-9"});
    EXPECT_SAYS(text, "limits.grain_balance_hard = 1e-09");
    EXPECT_SAYS(text, "at least limits.grain_balance_soft = 1e-08");
    EXPECT_SAYS(refusal("", {"limits.fluid_balance_soft=0.5"}), "limits.fluid_balance_hard");
    EXPECT_EQ(refusal("", {"limits.fluid_balance_hard=1", "limits.fluid_balance_soft=1"}), "");
}

TEST_F(FluidLimits, ExtraFieldsAndProbesAreNamedAndPlaced) {
    EXPECT_SAYS(refusal("", {"output.fields=vorticity curl"}), "There is no field curl");
    EXPECT_SAYS(refusal("", {"output.probes=[1, 2, 3]"}), "two for each point");
    EXPECT_SAYS(refusal("", {"output.probes=[1, 2, 3, 25]"}), "Point 2 is outside the box");
    const ResolvedCase both = load("", {"output.fields=solid vorticity", "output.probes=[1, 24]"});
    EXPECT_EQ(both.settings.text("run.probes"), "1 24");
}

TEST_F(FluidLimits, Equation21NeedsAWeight) {
    const std::vector<std::string> settling = {"scales.kind=sedimentation",
                                               "coupling.scheme=joint"};
    const auto with = [&](const char* ratio) {
        std::vector<std::string> sets = settling;
        sets.push_back(ratio);
        return sets;
    };
    EXPECT_SAYS(refusal("", with("grains.density_ratio=1")), "Eq. 21");
    // Light grains rise as fast as grains that are heavier by as much sink.
    EXPECT_EQ(load("", with("grains.density_ratio=0.5")).scales.gravity,
              load("", with("grains.density_ratio=1.5")).scales.gravity);
}

// 10 x 10 D at D/1000 are 1e8 cells: 75 GB.
TEST_F(FluidLimits, AMeshBeyondTheMemoryIsRefusedWithBoth) {
    const std::vector<std::string> fine = {"domain.size=[10, 10]", "fluid.cells_per_diameter=1000"};
    const auto with = [&](const char* set) {
        std::vector<std::string> sets = fine;
        sets.push_back(set);
        return refusal("", sets);
    };
    EXPECT_SAYS(with("limits.memory=60"), "The mesh of 100 million cells takes about 75.1 GB");
    EXPECT_SAYS(with("limits.memory=60"), "there are 60 GB (limits.memory)");
    EXPECT_EQ(with("limits.memory=80"), "");
    EXPECT_SAYS(with("domain.size=[1e6, 1e6]"), "OpenFOAM counts up to 5e+08");
    EXPECT_EQ(refusal("", {"fluid.enabled=false", "domain.size=[1e4, 1e4]"}), "");
}

TEST_F(FluidLimits, AGrainOfFewCellsIsRefusedByItsNumber) {
    EXPECT_EQ(refusal("", {"fluid.cells_per_diameter=4"}), "");
    EXPECT_SAYS(refusal("", {"fluid.cells_per_diameter=3"}), "at least 4 cells wide");
    EXPECT_EQ(refusal("", {"fluid.cells_per_diameter=3", "fluid.enabled=false"}), "");
}

}  // namespace
}  // namespace turbidite
