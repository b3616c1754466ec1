// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One disc on two that touch each other. The lines of contact are at 30 degrees to gravity. Each
// lower disc has two contacts (floor, upper disc) with the same tangential force, and is in
// equilibrium iff the force of the upper contact is at 15 degrees to its normal: mu >= tan 15 = 2 -
// sqrt 3 = 0.26795. The floor carries 3/2 weights and the same tangential force: mu_floor >=
// 0.0893.
#include <gtest/gtest.h>

#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

/// Displacement of the upper disc downwards at t = 2 [D].
double sinking(double friction, double dt) {
    Engine engine(scenes::exact(friction, 1e-10), scenes::discs, {scenes::floor(0.5)});
    engine.bodies().add(scenes::disc(1, -0.5, 0.5));
    engine.bodies().add(scenes::disc(2, 0.5, 0.5));
    const double top = 0.5 + std::sqrt(0.75);
    engine.bodies().add(scenes::disc(3, 0.0, top));
    EXPECT_TRUE(scenes::run(engine, 2.0, dt));
    return top - engine.bodies().position[2][1];
}

TEST(Pile, ThreeDiscsHoldJustAboveTheThreshold) {
    for (const double dt : {0.02, 0.01, 0.005}) EXPECT_NEAR(sinking(0.2685, dt), 0.0, 1e-8);
}

TEST(Pile, ThreeDiscsCollapseJustBelowIt) {
    for (const double dt : {0.02, 0.01, 0.005}) EXPECT_GT(sinking(0.2675, dt), 1e-4);
}

}  // namespace
}  // namespace turbidite::nscd
