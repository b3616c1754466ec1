// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/packing/packing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "launcher/case/grains/packing/lattice.hpp"
#include "launcher/case/grains/packing/random_numbers.hpp"
#include "launcher/case/grains/packing/random_packing.hpp"
#include "launcher/case/grains/population.hpp"

namespace turbidite {
namespace {

constexpr PackingBox paper_box{.width = 25.0, .height = 50.0};

bool is_sound(const Packing& grains, const PackingBox& box) {
    return check_population(grains, {"test", {}}, box, {}).empty();
}

double smallest_gap(const Packing& grains) {
    double smallest = 1e9;
    for (std::size_t i = 0; i < grains.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            smallest = std::min(
                smallest, std::hypot(grains[i].x - grains[j].x, grains[i].y - grains[j].y) - 1.0);
    return smallest;
}

TEST(Lattice, SpacingGivesTheCompacity) {
    EXPECT_NEAR(lattice_spacing(densest_compacity()), 1.0, 1e-7);
    EXPECT_NEAR(lattice_spacing(loosest_compacity()), std::numbers::sqrt2, 1e-7);
    const double a = lattice_spacing(0.85);
    EXPECT_NEAR(std::numbers::pi / 4.0 / (a * std::sqrt(1.0 - a * a / 4.0)), 0.85, 1e-12);
}

TEST(Lattice, DenseBoxOfThePaper) {
    // a = 1, rows of height sqrt(3)/2: 49 / 0.866 = 56.58, so 57 rows; 29 even ones of 25 grains
    // and 28 odd ones of 24: 725 + 672 = 1397.
    const PackingResult result = lattice_packing({.box = paper_box, .compacity = 0.9069});
    EXPECT_EQ(result.grains.size(), 1397u);
    EXPECT_EQ(result.notes.size(), 1u);  // 0.9069 is a rounding of pi / (2 sqrt 3) = 0.90690
    EXPECT_TRUE(is_sound(result.grains, paper_box));
    EXPECT_NEAR(smallest_gap(result.grains), 0.0, 1e-9);
}

TEST(Lattice, LooseBoxOfThePaper) {
    // a = sqrt 2, rows of height 1/sqrt 2: 49 x 1.41421 = 69.3, so 70 rows; 24 / 1.41421 = 16.97
    // gives 17 grains, odd rows (24 - 0.7071) / 1.41421 = 16.47 also 17: 70 x 17 = 1190.
    const PackingResult result = lattice_packing({.box = paper_box, .compacity = 0.7854});
    EXPECT_EQ(result.grains.size(), 1190u);
    EXPECT_TRUE(is_sound(result.grains, paper_box));
}

TEST(Lattice, ClampsOnlyRoundingErrors) {
    EXPECT_EQ(lattice_packing({.box = paper_box, .compacity = 0.9078}).grains.size(), 1397u);
    EXPECT_NE(lattice_packing({.box = paper_box, .compacity = 0.91}).refusal, "");
    EXPECT_EQ(lattice_packing({.box = paper_box, .compacity = 0.785}).grains.size(), 1190u);
    EXPECT_NE(lattice_packing({.box = paper_box, .compacity = 0.78}).refusal, "");
}

TEST(Lattice, JitterNeverMakesOverlap) {
    // Rows touch and the box leaves little space, so most grains cannot be moved; a note reports
    // this.
    const PackingResult result =
        lattice_packing({.box = paper_box, .compacity = 0.80, .jitter = 0.2, .seed = 5});
    EXPECT_TRUE(is_sound(result.grains, paper_box));
    ASSERT_EQ(result.notes.size(), 1u);
    EXPECT_NE(result.notes[0].find("had no room"), std::string::npos);
}

TEST(Lattice, FillsItsRegionAlone) {
    // The counts of the paper's column, whatever the size of the box around it.
    const PackingBox wide{.width = 250.0, .height = 100.0};
    for (const auto& [compacity, count] :
         {std::pair{0.9069, 1397u}, std::pair{0.84, 1290u}, std::pair{0.7854, 1190u}}) {
        PackingRequest request{
            .box = wide, .region = PackingRegion{25.0, 50.0}, .compacity = compacity};
        const Packing grains = lattice_packing(request).grains;
        EXPECT_EQ(grains.size(), count) << compacity;
        for (const PlacedGrain& grain : grains) {
            EXPECT_LE(grain.x, 24.5 + 1e-9);
            EXPECT_LE(grain.y, 49.5 + 1e-9);
        }
    }
}

TEST(Lattice, JitterMovesEveryGrainOfTheDensestLattice) {
    PackingRequest request{.box = {.width = 250.0, .height = 100.0},
                           .region = PackingRegion{25.0, 50.0},
                           .compacity = 0.9069};
    const Packing still = lattice_packing(request).grains;
    request.jitter = 1e-3;
    const PackingResult result = lattice_packing(request);
    ASSERT_EQ(result.grains.size(), still.size());
    EXPECT_TRUE(is_sound(result.grains, request.box));
    const double stretch = 1.0 + 2.0 * std::numbers::sqrt2 * request.jitter;
    int moved = 0;
    for (std::size_t i = 0; i < still.size(); ++i) {
        const double x = 0.5 + request.jitter + stretch * (still[i].x - 0.5);
        const double y = 0.5 + request.jitter + stretch * (still[i].y - 0.5);
        const double dx = std::abs(result.grains[i].x - x);
        const double dy = std::abs(result.grains[i].y - y);
        moved += dx > 0.0 && dy > 0.0;
        EXPECT_LE(std::max(dx, dy), request.jitter + 1e-12);
    }
    EXPECT_EQ(moved, 1397);
    // 0.9069 / (1 + 2 sqrt(2) 0.001)^2 = 0.9069 x 0.99437
    EXPECT_NE(result.notes.back().find("0.9018"), std::string::npos) << result.notes.back();
    EXPECT_EQ(result.notes.back().find("had no room"), std::string::npos);
}

TEST(Lattice, JitterCostsAtMostOnePercentOfTheCompacity) {
    PackingRequest request{.box = {.width = 250.0, .height = 100.0},
                           .region = PackingRegion{25.0, 50.0},
                           .compacity = 0.9069,
                           .jitter = 0.1};
    const PackingResult result = lattice_packing(request);
    EXPECT_TRUE(is_sound(result.grains, request.box));
    EXPECT_NE(result.notes.back().find("0.8979"), std::string::npos) << result.notes.back();
}

TEST(Lattice, JoinedSidesAreNotPulledApart) {
    // Ten touching grains across a periodic width of 10 D: no space along x.
    PackingRequest request{.box = {.width = 10.0, .height = 20.0, .periodic_x = true},
                           .region = PackingRegion{10.0, 1.0},
                           .compacity = 0.9069,
                           .jitter = 1e-3};
    const Packing grains = lattice_packing(request).grains;
    ASSERT_EQ(grains.size(), 10u);
    for (std::size_t i = 0; i < grains.size(); ++i) EXPECT_NEAR(grains[i].x, 0.5 + i, 1e-3);
}

TEST(Lattice, SeedDecidesTheJitter) {
    PackingRequest request{.box = paper_box, .compacity = 0.9069, .jitter = 1e-4, .seed = 1};
    request.box = {.width = 250.0, .height = 100.0};
    request.region = PackingRegion{25.0, 50.0};
    const std::string one = population_csv(lattice_packing(request).grains);
    EXPECT_EQ(one, population_csv(lattice_packing(request).grains));
    request.seed = 2;
    EXPECT_NE(one, population_csv(lattice_packing(request).grains));
}

TEST(RandomPacking, JitterMovesWithinItsBound) {
    // Gaps of 0.1 between grains, each moved by at most 0.03 along x and y: there is space for
    // every one.
    PackingRequest request{.box = {.width = 12.0, .height = 24.0}, .count = 60, .seed = 1};
    const Packing still = random_packing(request).grains;
    request.jitter = 0.03;
    const Packing moved = random_packing(request).grains;
    for (std::size_t i = 0; i < still.size(); ++i) {
        EXPECT_NE(moved[i].x, still[i].x);
        EXPECT_LE(std::abs(moved[i].x - still[i].x), 0.03);
        EXPECT_LE(std::abs(moved[i].y - still[i].y), 0.03);
    }
    EXPECT_TRUE(is_sound(moved, request.box));
}

TEST(RandomPacking, KeepsItsDistanceWhenThereIsRoom) {
    // 60 discs in 12 x 24: solid fraction 0.16, far below saturation.
    const PackingBox box{.width = 12.0, .height = 24.0};
    const PackingResult result = random_packing({.box = box, .count = 60, .seed = 1});
    ASSERT_EQ(result.grains.size(), 60u);
    EXPECT_GE(smallest_gap(result.grains), 0.1 - 1e-9);
    EXPECT_TRUE(is_sound(result.grains, box));
}

TEST(RandomPacking, DenseRequestsTakeLatticeSites) {
    // 70 discs in 9 x 9 give a solid fraction of 0.68, more than random addition can reach (0.547).
    const PackingBox box{.width = 9.0, .height = 9.0};
    const PackingResult result = random_packing({.box = box, .count = 70, .seed = 3});
    ASSERT_EQ(result.grains.size(), 70u);
    EXPECT_TRUE(is_sound(result.grains, box));
    EXPECT_NE(result.notes.at(0).find("lattice"), std::string::npos);
}

TEST(RandomPacking, StaysInItsRegion) {
    // 20 discs in 6 x 6, solid fraction 0.44, and 30 in 6 x 6, 0.65, from randomly displaced
    // lattice sites.
    for (const std::int64_t count : {20, 30}) {
        PackingRequest request{.box = {.width = 40.0, .height = 40.0},
                               .region = PackingRegion{6.0, 6.0},
                               .count = count};
        const Packing grains = random_packing(request).grains;
        ASSERT_EQ(grains.size(), static_cast<std::size_t>(count));
        EXPECT_TRUE(is_sound(grains, {.width = 6.0, .height = 6.0}));
    }
}

TEST(RandomPacking, RefusesWhatCannotFit) {
    // The densest lattice in 3 x 3 has rows of 3, 2, 3.
    const PackingResult result =
        random_packing({.box = {.width = 3.0, .height = 3.0}, .count = 50, .seed = 1});
    EXPECT_TRUE(result.grains.empty());
    EXPECT_NE(result.refusal.find("holds at most 8 grains"), std::string::npos) << result.refusal;
}

TEST(RandomPacking, SeedDecides) {
    const PackingRequest one{.box = paper_box, .count = 30, .seed = 1};
    const PackingRequest two{.box = paper_box, .count = 30, .seed = 2};
    EXPECT_EQ(population_csv(random_packing(one).grains),
              population_csv(random_packing(one).grains));
    EXPECT_NE(population_csv(random_packing(one).grains),
              population_csv(random_packing(two).grains));
}

TEST(RandomNumbers, AreTheSameEverywhere) {
    // The standard specifies the 10000th output of mt19937_64 with its default seed 5489 as
    // 9981545732273789042; our mapping uses its upper 53 bits.
    RandomNumbers random(5489);
    double last = 0.0;
    for (int i = 0; i < 10000; ++i) last = random.uniform();
    EXPECT_EQ(last, std::ldexp(static_cast<double>(9981545732273789042ull >> 11), -53));
}

}  // namespace
}  // namespace turbidite
