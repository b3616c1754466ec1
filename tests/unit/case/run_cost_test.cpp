// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The forecast of time and memory: how it grows with the case. What a machine takes is measured by
// bench/forecast.py.
#include "launcher/case/forecast/run_cost.hpp"

#include <algorithm>
#include <cstdlib>

#include "launcher/case/forecast/mesh_cost.hpp"
#include "tests/unit/case/case_test.hpp"

namespace turbidite {
namespace {

class RunCost : public CaseTest {
 protected:
    // 192 x 192 cells and 15 discs.
    RunCost()
        : CaseTest(
              "domain: {size: [12, 12]}\n"
              "grains: {adapter: yade-nscd, count: 15}\n"
              "fluid: {reynolds: 30, cells_per_diameter: 16}\n"
              "time: {step: 0.01, end: 10}\n") {}

    ResolvedCase of(const std::vector<std::string>& overrides = {}) const {
        return load("", overrides);
    }
    /// With a core for every rank.
    WindowForecast window(const std::vector<std::string>& overrides = {}) const {
        return forecast_window(of(overrides), 64.0);
    }
};

TEST_F(RunCost, FluidGrowsWithCellsAndGrains) {
    const double usual = window().fluid;
    EXPECT_GT(usual, 0.0);
    EXPECT_DOUBLE_EQ(window({"fluid.cells_per_diameter=32"}).fluid, 4.0 * usual);
    // Four times the domain: as many grains, so less than four times as much.
    EXPECT_GT(window({"domain.size=[24, 24]"}).fluid, 2.0 * usual);
    EXPECT_LT(window({"domain.size=[24, 24]"}).fluid, 4.0 * usual);
    EXPECT_GT(window({"grains.count=30"}).fluid, usual);
    EXPECT_LT(window({"grains.count=30"}).fluid, 2.0 * usual);
}

TEST_F(RunCost, SplittingsAndTimeSchemesDiffer) {
    const double paper = window().fluid;
    const double carried = window({"fluid.splitting=explicit-multiplier"}).fluid;
    EXPECT_GT(carried, paper);
    EXPECT_GT(window({"fluid.splitting=implicit-multiplier"}).fluid, carried);
    EXPECT_LT(window({"fluid.time_scheme=first-order"}).fluid, paper);
}

// The covered cells are not spread evenly: grains settle in the lower ranks.
TEST_F(RunCost, RanksShareTheFluidButNotEvenly) {
    const double alone = window().fluid;
    const double shared = window({"fluid.ranks=4"}).fluid;
    EXPECT_LT(shared, alone);
    EXPECT_GT(shared, alone / 4.0);
}

// Sixteen ranks on two cores took 15 times as long as two.
TEST_F(RunCost, RanksBeyondTheCoresCostTime) {
    const ResolvedCase two = of({"fluid.ranks=2"}), sixteen = of({"fluid.ranks=16"});
    EXPECT_LT(forecast_window(two, 2.0).seconds(), forecast_window(of(), 2.0).seconds());
    EXPECT_GT(forecast_window(of({"fluid.ranks=4"}), 2.0).seconds(),
              forecast_window(two, 2.0).seconds());
    EXPECT_GT(forecast_window(sixteen, 2.0).seconds(), 5.0 * forecast_window(two, 2.0).seconds());
    EXPECT_LT(forecast_window(sixteen, 16.0).seconds(), forecast_window(two, 16.0).seconds());
    // Nor do grains: ranks without a core of their own save no time.
    const auto grains = [&](const char* ranks, double cores) {
        return forecast_window(of({"grains.adapter=standalone-nscd", ranks}), cores).grains;
    };
    EXPECT_EQ(grains("grains.ranks=16", 2.0), grains("grains.ranks=2", 2.0));
    EXPECT_LT(grains("grains.ranks=2", 2.0), grains("grains.ranks=1", 2.0));

    EXPECT_EQ(ranks_warning(two, 2.0), "");
    EXPECT_EQ(ranks_warning(sixteen, 16.0), "");
    EXPECT_EQ(ranks_warning(of({"fluid.ranks=16", "fluid.enabled=false"}), 2.0), "");
    const std::string warning = ranks_warning(sixteen, 2.0);
    EXPECT_EQ(warning.find("fluid.ranks = 16 on 2 cores: "), 0u) << warning;
    EXPECT_NE(warning.find("Use fluid.ranks = 2 or fewer"), std::string::npos) << warning;
}

// The cores of a batch job of several nodes are not those of the machine that asks.
TEST_F(RunCost, CoresOfABatchJobAreNotCountedHere) {
    EXPECT_GE(cores_for_a_job(), 1.0);
    EXPECT_LT(cores_for_a_job(), 1e6);
    ::setenv("SLURM_JOB_NUM_NODES", "4", 1);
    EXPECT_EQ(ranks_warning(of({"fluid.ranks=16"})), "");
    ::unsetenv("SLURM_JOB_NUM_NODES");
}

TEST_F(RunCost, GrainsGrowWithTheirNumberAndWhatTheyNeed) {
    const double discs = window().grains;
    EXPECT_DOUBLE_EQ(window({"grains.count=30"}).grains, 2.0 * discs);
    EXPECT_DOUBLE_EQ(window({"grains.count=30"}).coupler, 2.0 * window().coupler);
    EXPECT_GT(window({"grains.shape=triangle"}).grains, discs);
    const std::vector<std::string> springs{"grains.adapter=yade-md", "coupling.scheme=split"};
    EXPECT_GT(window(springs).grains, discs);
    const std::string own = "grains.adapter=standalone-md";
    EXPECT_LT(window({own}).grains, window(springs).grains);
    EXPECT_GT(window({own, "grains.shape=triangle"}).grains, window({own}).grains);
    EXPECT_GT(window({springs[0], "coupling.scheme=sub-iterated"}).grains, window(springs).grains);
}

// Under split grains and fluid work at the same time; joint hands over more often.
TEST_F(RunCost, SchemesDifferInWhoWaitsForWhom) {
    const WindowForecast joint = window(), split = window({"coupling.scheme=split"});
    EXPECT_DOUBLE_EQ(joint.seconds(), joint.fluid + joint.grains + joint.coupler + joint.messages);
    EXPECT_DOUBLE_EQ(split.seconds(),
                     std::max(split.fluid, split.grains) + split.coupler + split.messages);
    EXPECT_LT(split.messages, joint.messages);
}

TEST_F(RunCost, ARunIsItsWindowsAndItsStart) {
    const double one = predicted_seconds(of()), two = predicted_seconds(of({"time.end=20"}));
    EXPECT_NEAR(two - one, 1000.0 * window().seconds(), 1e-9);
    EXPECT_GT(one, 1000.0 * window().seconds());
    EXPECT_LT(predicted_seconds(of({"grains.adapter=standalone-nscd"})), one);
}

TEST_F(RunCost, MemoryIsThatOfAllPrograms) {
    const ResolvedCase wet = of();
    EXPECT_GT(predicted_memory(wet), fluid_memory(wet.settings));
    EXPECT_LT(predicted_memory(of({"grains.adapter=standalone-nscd"})), predicted_memory(wet));
    EXPECT_LT(predicted_memory(of({"fluid.enabled=false"})), predicted_memory(wet));
    EXPECT_EQ(forecast_window(of({"fluid.enabled=false"})).fluid, 0.0);
}

}  // namespace
}  // namespace turbidite
