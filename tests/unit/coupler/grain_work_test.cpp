// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/measures/grain_work.hpp"

#include <gtest/gtest.h>

#include "tests/unit/coupler/test_case.hpp"

namespace turbidite {
namespace {

/// One window of the test population; grain 101 goes from (1, 0) to (3, 2) and its spin from 0
/// to 4.
struct TurningGrain {
    Motion before;
    WindowResult result;

    TurningGrain() {
        before.grains = test_population();
        before.grains[1].velocity = {1, 0, 0};
        result.state.grains = before.grains;
        result.state.grains[1].velocity = {3, 2, 0};
        result.state.grains[1].angular_velocity = {0, 0, 4};
        result.motion.grains = result.state.grains;
        result.motion.grains[1].contact_impulse = {5, 7, 0};
        result.motion.grains[1].contact_angular_impulse = {0, 0, 11};
        result.kicks.kicks.resize(1);
        result.kicks.kicks[0].id = 101;
        result.kicks.kicks[0].force = {-1, 3, 0};
        result.kicks.kicks[0].torque = {0, 0, -2};
    }
};

// Mean velocity (2, 1), mean spin 2: contacts 10 + 7 + 22, fluid 0.1 (-2 + 3 - 4).
TEST(GrainWork, IsImpulseTimesMeanVelocity) {
    const TurningGrain window;
    const GrainWork work = WorkOnGrains()(window.before, window.result, 0.1);
    EXPECT_NEAR(work.contacts, 39.0, 1e-14);
    EXPECT_NEAR(work.fluid, -0.3, 1e-14);
}

// Impulses that change the velocities of a grain as they do give the change of its kinetic energy.
TEST(GrainWork, IsTheChangeOfTheKineticEnergy) {
    TurningGrain window;
    const double mass = 2.5, inertia = 0.4;
    window.result.kicks.kicks.clear();
    window.result.motion.grains[1].contact_impulse = {2.0 * mass, 2.0 * mass, 0};
    window.result.motion.grains[1].contact_angular_impulse = {0, 0, 4.0 * inertia};
    const double change = 0.5 * mass * (9.0 + 4.0 - 1.0) + 0.5 * inertia * 16.0;
    EXPECT_NEAR(WorkOnGrains()(window.before, window.result, 0.1).contacts, change, 1e-13);
}

// Dry schemes have no step 4 of their own.
TEST(GrainWork, OfADryWindowIsThatOfItsState) {
    TurningGrain window;
    window.result.state.grains[1].contact_impulse = {5, 7, 0};
    window.result.motion.grains.clear();
    EXPECT_NEAR(WorkOnGrains()(window.before, window.result, 0.1).contacts, 17.0, 1e-14);
}

TEST(GrainWork, OfGrainsThatAreDrivenOrHaveLeftDoesNotCount) {
    TurningGrain driven;
    driven.before.grains[1].prescribed = true;
    EXPECT_EQ(WorkOnGrains()(driven.before, driven.result, 0.1).contacts, 0.0);
    TurningGrain gone;
    gone.result.state.grains.erase(gone.result.state.grains.begin() + 1);
    const GrainWork work = WorkOnGrains()(gone.before, gone.result, 0.1);
    EXPECT_EQ(work.contacts, 0.0);
    EXPECT_EQ(work.fluid, 0.0);
}

}  // namespace
}  // namespace turbidite
