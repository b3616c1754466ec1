// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/scales.hpp"

#include <gtest/gtest.h>

#include "launcher/case/case_file.hpp"
#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {
namespace {

ResolvedCase with_scales(const std::string& scales, const std::string& more = "") {
    const ScratchFolder folder;
    return load_case(folder.write("case.yaml",
                                  "domain: {size: [10, 20]}\ngrains: {count: 5}\n"
                                  "time: {step: 0.01, end: 2}\nscales: {" +
                                      scales + "}\n" + more));
}

TEST(Scales, Avalanche) {
    const ResolvedCase run = with_scales("kind: avalanche", "fluid: {reynolds: 40}\n");
    EXPECT_DOUBLE_EQ(run.scales.gravity, 1.0);
    EXPECT_DOUBLE_EQ(run.scales.time, 1.0);
    EXPECT_DOUBLE_EQ(run.settings.real("run.viscosity"), 0.025);  // 1 / 40
}

TEST(Scales, SedimentationGravity) {
    // 1 = (pi/2) (1.5 - 1) g 0.8^10 gives g = 1 / (0.7853982 x 0.1073742) = 11.85797.
    const ResolvedCase run = with_scales("kind: sedimentation", "fluid: {reynolds: 36}\n");
    EXPECT_NEAR(run.settings.real("run.gravity"), 11.85797, 1e-4);
    EXPECT_DOUBLE_EQ(run.scales.velocity, 1.0);
}

TEST(Scales, PhysicalValuesWithoutVelocity) {
    // (pi/2) 1e-3 x 0.5 x 9.81 = 7.704756e-3, root 0.0877767, times 0.8^5 = 0.32768: 0.0287627 m/s.
    const ResolvedCase run = with_scales(
        "kind: physical, diameter: 1e-3, gravity: 9.81, fluid_density: 1000, viscosity: 1e-6");
    EXPECT_NEAR(run.scales.velocity, 0.0287627, 1e-6);
    EXPECT_NEAR(run.scales.reynolds, 28.7627, 1e-3);
    EXPECT_NEAR(run.scales.time, 1e-3 / 0.0287627, 1e-5);
    EXPECT_NEAR(run.settings.real("run.step"), 0.01e-3 / 0.0287627, 1e-8);
    EXPECT_DOUBLE_EQ(run.settings.real("run.size_y"), 20e-3);
    EXPECT_DOUBLE_EQ(run.population.at(0).radius, 0.5e-3);
    EXPECT_DOUBLE_EQ(run.population.at(0).density, 1500.0);
}

TEST(Scales, PhysicalValuesWithVelocity) {
    const ResolvedCase run = with_scales(
        "kind: physical, diameter: 1e-3, gravity: 9.81, fluid_density: 1000, "
        "viscosity: 1e-6, velocity: 0.05");
    EXPECT_DOUBLE_EQ(run.scales.velocity, 0.05);
    EXPECT_DOUBLE_EQ(run.settings.real("run.time_scale"), 0.02);
}

}  // namespace
}  // namespace turbidite
