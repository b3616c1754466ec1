// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/domain/side_motion.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/run_settings.hpp"

namespace turbidite {
namespace {

/// The top, with the parabolic profile, and this motion under one of the two keys.
SideMotion top_with(const char* key) {
    Settings settings = run_settings();
    settings.set("domain.top_profile", std::string("parabolic"));
    settings.set(key, std::string("3 constant 1 0 0"));
    return side_motions(settings)[3];
}

// `check` says of a wall that its profile has no effect.
TEST(SideMotion, AWallThatSlidesHasNoProfile) {
    const SideMotion lid = top_with("run.wall_motions"), inflow = top_with("run.inflow_motions");
    for (const double from : {0.0, 0.3, 0.9}) EXPECT_EQ(lid.share(from, from + 0.1), 1.0);
    EXPECT_NEAR(inflow.share(0.0, 0.1), 10.0 * 0.1 * 0.1 * 2.8, 1e-14);  // s^2 (3 - 2 s)
    EXPECT_EQ(lid.velocity(0.5, 0.1), (Vec3{1.0, 0.0, 0.0}));
    EXPECT_EQ(inflow.velocity(0.5, 0.1), lid.velocity(0.5, 0.1));
}

}  // namespace
}  // namespace turbidite
