// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "granular_adapter/nscd/laws/law_list.hpp"
#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

// dt = 0.01, fraction 0.2, speed 0.5: g/dt when open; 0.2 g/dt for small overlaps; 0.5 beyond
// 0.5 * 0.01/0.2 = 0.025.
TEST(Recovery, IsAShareOfTheOverlapAndCapped) {
    const auto law =
        make_law_part(LawSlot::gap, "signorini", {0.2, 0.5}, SurfaceTable({Surface{}}));
    const auto bias = [&law](double gap) {
        ContactSituation situation;
        situation.gap = gap;
        situation.step = 0.01;
        LawTerms terms;
        law->add(situation, terms);
        return terms.normal_bias;
    };
    EXPECT_NEAR(bias(0.003), 0.3, 1e-15);
    EXPECT_NEAR(bias(-0.001), -0.02, 1e-15);
    EXPECT_NEAR(bias(-0.024), -0.48, 1e-14);
    EXPECT_NEAR(bias(-0.026), -0.5, 1e-15);
}

/// Overlap of a weightless disc with the floor after each step.
std::vector<double> overlaps(double start, double dt, int steps) {
    EngineSettings settings = scenes::exact(0.0);
    Engine engine(settings, scenes::discs, {scenes::floor(0.0)});
    engine.bodies().add(scenes::disc(1, 0.0, 0.5 - start));
    std::vector<double> result;
    for (int n = 0; n < steps; ++n) {
        engine.step(dt);
        engine.move(dt);
        engine.bodies().twist[0] = {};
        result.push_back(engine.max_penetration());
    }
    return result;
}

// Each step leaves 80 % of a small overlap, whatever the time step; a deep one (0.1 D) decreases by
// 0.5 dt.
TEST(Recovery, RemovesOverlapGradually) {
    for (const double dt : {0.02, 0.01, 0.005}) {
        const auto small = overlaps(0.001, dt, 5);
        for (int n = 0; n < 5; ++n) EXPECT_NEAR(small[n], 0.001 * std::pow(0.8, n + 1), 1e-14);
        const auto deep = overlaps(0.1, dt, 3);
        for (int n = 0; n < 3; ++n) EXPECT_NEAR(deep[n], 0.1 - 0.5 * dt * (n + 1), 1e-14);
    }
}

TEST(Recovery, RefusesSharesBeyondOne) {
    const SurfaceTable surfaces({Surface{}});
    EXPECT_THROW(make_law_part(LawSlot::gap, "signorini", {1.1, 0.5}, surfaces),
                 std::invalid_argument);
    EXPECT_THROW(make_law_part(LawSlot::gap, "signorini", {0.2, -0.5}, surfaces),
                 std::invalid_argument);
}

}  // namespace
}  // namespace turbidite::nscd
