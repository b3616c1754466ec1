// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/warm_start.hpp"

#include <gtest/gtest.h>

#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

// Impulse 0.2 over dt = 0.01 is a force of 20: 0.1 over half the step.
TEST(ContactMemory, KeepsForcesAndMatchesByKey) {
    ContactMemory memory;
    memory.remember({{7, 9, 0, 0}, {3, 9, 1, 0}, {7, 9, 0, 1}},
                    {in_plane(0.2, -0.1), in_plane(0.4, 0.0), {}}, 0.01);
    EXPECT_NEAR(memory.guess({7, 9, 0, 0}, 0.005).n, 0.1, 1e-16);
    EXPECT_NEAR(memory.guess({7, 9, 0, 0}, 0.005).t, -0.05, 1e-16);
    EXPECT_NEAR(memory.guess({3, 9, 1, 0}, 0.01).n, 0.4, 1e-16);
    EXPECT_EQ(memory.guess({3, 9, 0, 0}, 0.01), (ContactVector{}));
    EXPECT_EQ(memory.guess({7, 9, 0, 1}, 0.01), (ContactVector{}));
    EXPECT_EQ(memory.contacts().size(), 2u);
}

class WarmStart : public ::testing::Test {
 protected:
    WarmStart() : engine_(scenes::settling_pack(10, 10, scenes::exact(0.3, 1e-3))) {
        scenes::run(engine_, 14.0, 0.01);
        at_rest_ = engine_.save();
    }

    /// Sweeps over 50 steps of the pack at rest.
    std::int64_t sweeps(bool warm, double dt) {
        engine_.restore(at_rest_);
        std::int64_t sum = 0;
        for (int n = 0; n < 50; ++n) {
            if (!warm) engine_.memory().forget();
            sum += engine_.step(dt).iterations;
            engine_.move(dt);
        }
        return sum;
    }

 private:
    Engine engine_;
    std::vector<char> at_rest_;
};

// At rest the last step's forces are the solution: less than half the sweeps, also with a shorter
// step.
TEST_F(WarmStart, SavesSweeps) {
    for (const double dt : {0.01, 0.005, 0.0025})
        EXPECT_LT(2 * sweeps(true, dt), sweeps(false, dt));
}

}  // namespace
}  // namespace turbidite::nscd
