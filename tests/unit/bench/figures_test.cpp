// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The arithmetic of a comparison, and the transfer of a sample from a contender to the benchmark.
#include <gtest/gtest.h>

#include <fstream>

#include "bench/fluid/start_flow.hpp"
#include "bench/timing/site.hpp"
#include "coupler/protocol/failure.hpp"
#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite::bench {
namespace {

double processor(const Sample& sample) {
    return sample.processor;
}

TEST(Figures, MedianIsTheMiddleOrTheMeanOfTheMiddleTwo) {
    EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
    EXPECT_EQ(median({4.0, 1.0, 3.0, 2.0}), 2.5);
    EXPECT_THROW(median({}), std::invalid_argument);
}

TEST(Figures, RatioIsOfMediansAndItsSpreadTurnByTurn) {
    // First: 8, 6, 100 (a disturbed turn); second: 2, 3, 4. Medians 8 and 3.
    const double first[] = {8.0, 6.0, 100.0}, second[] = {2.0, 3.0, 4.0};
    int turn = 0;
    std::string order;
    const auto contender = [&](char name, const double* seconds, int each) {
        order += name;
        Sample sample;
        sample.processor = seconds[each];
        return sample;
    };
    const Duel duel = alternate(
        3, [&] { return contender('a', first, turn); },
        [&] { return contender('b', second, turn++); });
    EXPECT_EQ(order, "ababab");
    const Measured measured = ratio(duel, processor);
    EXPECT_DOUBLE_EQ(measured.value, 8.0 / 3.0);
    EXPECT_DOUBLE_EQ(measured.lowest, 2.0);
    EXPECT_DOUBLE_EQ(measured.highest, 25.0);
}

TEST(Figures, ReachOfEachKind) {
    const Reach least{Reach::Kind::at_least, 12.0}, most{Reach::Kind::at_most, 3.0};
    EXPECT_TRUE(least.met(12.0));
    EXPECT_FALSE(least.met(11.9));
    EXPECT_TRUE(most.met(3.0));
    EXPECT_FALSE(most.met(3.1));
    EXPECT_TRUE(Reach{}.met(1e9));
    EXPECT_EQ(least.text(), ">= 12");
    EXPECT_EQ(most.text(), "<= 3");
    EXPECT_EQ(Reach{}.text(), "");
}

TEST(Figures, ASampleSurvivesItsFile) {
    const ScratchFolder scratch;
    Sample sample{0.125, 0.25, 4096.0, 72.0, {{"1 projection", 0.0625}}, {{"sweeps", 12.0}}};
    write_sample(sample, scratch.path() / "sample.json");
    const Sample back = read_sample(scratch.path() / "sample.json");
    EXPECT_EQ(back.processor, 0.125);
    EXPECT_EQ(back.wall, 0.25);
    EXPECT_EQ(back.resident, 4096.0);
    EXPECT_EQ(back.arrays, 72.0);
    EXPECT_EQ(back.parts, sample.parts);
    EXPECT_EQ(back.counts, sample.counts);
    EXPECT_THROW(write_sample(sample, scratch.path() / "none/sample.json"), Failure);
    EXPECT_THROW(read_sample(scratch.write("broken.json", "{\"processor\": 1}")), Failure);
    EXPECT_THROW(read_sample(scratch.path() / "missing.json"), Failure);
}

// 8 MiB written are 8 MiB resident; other memory of the process varies by less than half of that.
TEST(Figures, ResidentMemoryGrowsByWhatIsTouched) {
    const double before = resident_bytes();
    const std::vector<double> touched(8 << 17, 1.0);
    EXPECT_NEAR(resident_bytes() - before, sizeof(double) * touched.size(), 1 << 22);
}

TEST(Figures, StartFlowHasNoDivergenceAndRestsOnTheWalls) {
    const double lx = 20.0, ly = 60.0, d = 1e-5;
    const auto u = [&](double x, double y) { return start_flow(lx, ly, x, y); };
    for (double s : {1.3, 7.7, 18.2}) {
        const double x = s, y = 2.7 * s;
        const double divergence =
            (u(x + d, y).first - u(x - d, y).first + u(x, y + d).second - u(x, y - d).second) /
            (2.0 * d);
        EXPECT_NEAR(divergence, 0.0, 1e-8);  // second order in d, and rounding over d
        for (const auto& [wall_u, wall_v] : {u(0.0, y), u(lx, y), u(x, 0.0), u(x, ly)}) {
            EXPECT_NEAR(wall_u, 0.0, 1e-12);
            EXPECT_NEAR(wall_v, 0.0, 1e-12);
        }
    }
}

}  // namespace
}  // namespace turbidite::bench
