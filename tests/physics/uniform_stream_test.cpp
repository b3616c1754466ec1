// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/physics/coupled_run.hpp"

namespace turbidite {
namespace {

CoupledSetup cyclic_box(const std::string& points) {
    CoupledSetup setup;
    setup.left = setup.right = setup.bottom = setup.top = "cyclic";
    setup.points = points;
    return setup;
}

class UniformStream : public testing::TestWithParam<std::string> {};

/// Fluid and disc move with (0.7, -0.4): there is no force, however long they move.
TEST_P(UniformStream, IsNotDisturbedByADiscMovingWithIt) {
    const CoupledSetup setup = cyclic_box(GetParam());
    CoupledRun run(setup, {disc_at(setup, 2.03, 0.31, 0.7, -0.4)});
    run.fluid().add_velocity(0.7, -0.4);
    for (int n = 0; n < 100; ++n) {  // crosses the lower side, but no other (x = 2.73)
        run.advance();
        ASSERT_NEAR(run.grains()[0].velocity[0], 0.7, 1e-12);
        ASSERT_NEAR(run.grains()[0].velocity[1], -0.4, 1e-12);
        ASSERT_NEAR(run.grains()[0].angular_velocity[2], 0.0, 1e-12);
    }
    for (int j = 0; j < 64; ++j)
        for (int i = 0; i < 64; ++i) {
            EXPECT_NEAR(run.fluid().velocity(i, j)[0], 0.7, 1e-11);
            EXPECT_NEAR(run.fluid().velocity(i, j)[1], -0.4, 1e-11);
        }
}

/// A disc faster than the stream exchanges momentum with the fluid in a box without other forces:
/// the sum of cM U and the fluid's momentum is conserved, to the tolerance of the solvers. The disc
/// begins with its velocity in the fluid that it covers too.
TEST_P(UniformStream, SharesMomentumInACyclicBox) {
    const CoupledSetup setup = cyclic_box(GetParam());
    CoupledRun run(setup, {disc_at(setup, 2.03, 2.01, 1.0, 0.0)});
    const double cM = run.body().effective_mass;
    const auto momentum = [&] {
        double fluid = 0.0;
        for (int j = 0; j < 64; ++j)
            for (int i = 0; i < 64; ++i) fluid += run.fluid().velocity(i, j)[0] / 256.0;
        return cM * run.grains()[0].velocity[0] + fluid;
    };
    run.advance();
    const double first = momentum();
    // rho_s V, and with boundary points 2 % more, of the cells around it
    EXPECT_NEAR(first / run.body().mass, GetParam() == "interior" ? 0.993 : 1.018, 0.005);
    for (int n = 1; n < 50; ++n) {
        run.advance();
        ASSERT_LT(run.answer().report.momentum_defect, 1e-6);
    }
    EXPECT_NEAR(momentum(), first, 1e-7 * first);
    EXPECT_LT(run.grains()[0].velocity[0], 0.6);  // 1.5/(1.5 + 1) with the added mass, and slower
}

INSTANTIATE_TEST_SUITE_P(Points, UniformStream, testing::Values("interior", "interior+boundary"),
                         [](const auto& info) {
                             return info.param == "interior" ? "interior" : "boundary";
                         });

}  // namespace
}  // namespace turbidite
