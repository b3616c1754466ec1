// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Twenty discs on top of each other: the contact below the k-th from the top carries k weights.
#include <gtest/gtest.h>

#include "granular_adapter/nscd/problem/residual.hpp"
#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

constexpr int height = 20;

Engine stack(double tolerance) {
    Engine engine(scenes::exact(0.3, tolerance), scenes::discs, {scenes::floor(0.3)});
    for (int k = 0; k < height; ++k) engine.bodies().add(scenes::disc(k, 0.0, 0.5 + k));
    return engine;
}

// The chain's W over W_nn has its smallest eigenvalue near (pi/41)^2/2 = 3e-3, so a natural map of
// 1e-10 leaves at most 1e-10/3e-3 of |r| = m g dt sqrt(20 21 41/6) = 54 m g dt: 2e-6 m g dt.
TEST(Stack, ReactionsEqualTheWeightsAbove) {
    for (const double dt : {0.02, 0.01, 0.005}) {
        Engine engine = stack(1e-10);
        for (int n = 0; n < 20; ++n) {
            EXPECT_TRUE(engine.step(dt).converged);
            engine.move(dt);
        }
        const double weight = std::numbers::pi / 4 * dt;
        int contacts = 0;
        for (std::size_t k = 0; k < engine.points().size(); ++k) {
            const double above = height - double(engine.bodies().id[engine.points()[k].b]);
            EXPECT_NEAR(engine.impulses()[k].n, above * weight, 2e-6 * weight);
            EXPECT_NEAR(engine.impulses()[k].t, 0.0, 2e-6 * weight);
            ++contacts;
        }
        EXPECT_EQ(contacts, height);
        EXPECT_LT(engine.max_penetration(), 1e-9);
    }
}

// At rest the floor carries everything: the momentum balance differs only by the velocities that
// are not exactly zero.
TEST(Stack, FloorCarriesTheTotalWeight) {
    Engine engine = stack(1e-12);
    EXPECT_TRUE(engine.step(0.01).converged);
    const double weight = std::numbers::pi / 4 * 0.01;
    double floor = 0.0, momentum = 0.0;
    for (std::size_t k = 0; k < engine.points().size(); ++k)
        if (engine.points()[k].wall >= 0) floor += engine.impulses()[k].n;
    for (std::size_t i = 0; i < engine.bodies().size(); ++i)
        momentum += engine.bodies().mass[i] * engine.bodies().twist[i].velocity[1];
    EXPECT_NEAR(floor - momentum, height * weight, 1e-12 * height * weight);
    EXPECT_NEAR(floor, height * weight, 1e-8 * height * weight);
}

// Quad, the customary criterion, is the change by one update; the natural map must not be smaller
// by orders of magnitude.
TEST(Stack, LooseToleranceIsReportedAsSuch) {
    Engine engine = stack(1e-2);
    const StepReport report = engine.step(0.01);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.residual, 1e-2);
    EXPECT_GT(report.residual, 1e-6);
    EXPECT_EQ(report.residual, natural_map_residual(engine.problem(), engine.impulses()));
}

}  // namespace
}  // namespace turbidite::nscd
