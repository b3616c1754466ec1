// SPDX-License-Identifier: GPL-3.0-or-later
//
// One disc in a box, against the force balance of the scheme. Gravity as in sedimentation at
// density
// ratio 1.5 and compacity 0.2: g = u_c^2 / ((pi D/2)(1/2)(1 - 0.2)^10) = 11.86 u_c^2/D.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "fluid_adapter/foam_case/fluid_case.hpp"
#include "tests/physics/coupled_run.hpp"

namespace turbidite {
namespace {

constexpr double g = 11.86;

CoupledSetup settling(const std::string& points) {
    CoupledSetup setup;
    setup.gravity = g;
    setup.reynolds = 36.0;
    setup.points = points;
    return setup;
}

class SettlingDisc : public testing::TestWithParam<std::string> {};

/// Grain side, to round-off, in flight and at rest on the floor: M (U' - U)/dt = -(M - m_f) g + F_c
/// + F_h with F_h = J_lambda/dt + m_f (U' - U)/dt. Fluid side, to solver tolerance: its own
/// momentum changed by -J_lambda and by what crossed the walls.
TEST_P(SettlingDisc, BalancesForcesInEveryWindow) {
    const CoupledSetup setup = settling(GetParam());
    CoupledRun run(setup, {disc_at(setup, 2.03, 1.5)});
    const ImmersedBody body = run.body();
    const double weight = body.submerged_mass * g;
    bool landed = false;
    for (int n = 0; n < 300; ++n) {
        run.advance();
        const double dU = run.grains()[0].velocity[1] - run.before()[0].velocity[1];
        const Kick& kick = run.answer().kicks[0];
        const double contact = run.between()[0].contact_impulse[1] / setup.step;
        const double hydrodynamic =
            kick.multiplier_impulse[1] / setup.step + body.displaced_mass * dU / setup.step;
        EXPECT_NEAR(body.mass * dU / setup.step, -weight + contact + hydrodynamic, 1e-10 * weight);
        EXPECT_LT(run.answer().report.momentum_defect, 1e-6);
        EXPECT_LT(run.answer().report.divergence, 1e-4);
        landed |= contact > 0.0;
    }
    EXPECT_TRUE(landed);
    EXPECT_NEAR(run.grains()[0].position[1], 0.5, 0.01);
}

/// A disc in the middle of a symmetric box stays in the middle and does not rotate.
TEST_P(SettlingDisc, FallsStraightInASymmetricBox) {
    const CoupledSetup setup = settling(GetParam());
    CoupledRun run(setup, {disc_at(setup, 2.0, 3.0)});
    for (int n = 0; n < 60; ++n) run.advance();
    EXPECT_LT(run.grains()[0].velocity[1], -0.2);
    EXPECT_NEAR(run.grains()[0].position[0], 2.0, 2e-3);
    EXPECT_NEAR(run.grains()[0].angular_velocity[2], 0.0, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Points, SettlingDisc, testing::Values("interior", "interior+boundary"),
                         [](const auto& info) {
                             return info.param == "interior" ? "interior" : "boundary";
                         });

TEST(SettlingDiscRefusal, NotANumberNamesStepAndWindow) {
    const CoupledSetup setup = settling("interior+boundary");
    CoupledRun run(setup, {disc_at(setup, 2.0, 3.0)});
    run.advance();
    std::vector<GrainState> bad = run.grains();
    bad[0].velocity[0] = std::nan("");
    run.fluid().advance({1, setup.step, setup.step, false});
    try {
        run.fluid().correct({1, setup.step, setup.step, false}, bad);
        run.fluid().impose({1, setup.step, setup.step, false});
        FAIL() << "accepted a velocity that is not a number";
    } catch (const PhysicsRefused& refused) {
        EXPECT_NE(std::string(refused.what()).find("step 5"), std::string::npos) << refused.what();
        EXPECT_NE(std::string(refused.what()).find("window 1"), std::string::npos)
            << refused.what();
    }
}

TEST(SettlingDiscRefusal, AProjectionThatDoesNotConvergeNamesStepAndWindow) {
    CoupledSetup setup = settling("interior+boundary");
    setup.pressure_solver = "GAMG";
    const TemporaryFolder folder;
    write_fluid_case(settings_of(setup), folder.path());
    build_fluid_mesh(folder.path(), folder.path() / "blockMesh.log");
    // Two sweeps cannot replace the ten or so that are needed.
    std::ofstream(folder.path() / "system" / "fvSolution", std::ios::app)
        << "solvers { p { maxIter 2; } }\n";
    FoamAdapter fluid(folder.path());
    fluid.initialise(settings_of(setup), {ShapeRecord{"disc", {}}});
    fluid.advance({0, 0.0, setup.step, false});  // fluid at rest: nothing to solve
    fluid.correct({0, 0.0, setup.step, false}, {disc_at(setup, 2.0, 2.0, 0.0, -0.1)});
    fluid.impose({0, 0.0, setup.step, false});
    try {
        fluid.advance({1, setup.step, setup.step, false});
        FAIL() << "went on without a pressure";
    } catch (const PhysicsRefused& refused) {
        EXPECT_NE(std::string(refused.what()).find("step 1 (projection) of window 1"),
                  std::string::npos)
            << refused.what();
    }
}

/// Two discs whose points share cells: one iteration is not enough for them, two hundred are.
TEST(SettlingDiscs, MultipliersThatStopAtTheirLimitAreReported) {
    CoupledSetup setup = settling("interior+boundary");
    for (const std::int64_t limit : {1, 200}) {
        setup.multiplier_iterations = limit;
        setup.tolerance = 1e-8;
        CoupledRun run(setup, {disc_at(setup, 1.4, 2.5), disc_at(setup, 2.52, 2.55)});
        for (int n = 0; n < 3; ++n) run.advance();
        EXPECT_EQ(run.answer().report.multipliers_converged, limit == 200);
        EXPECT_GE(run.answer().report.multiplier_iterations, limit == 200 ? 2 : 1);
        EXPECT_LE(run.answer().report.multiplier_iterations, limit);
    }
}

TEST(SettlingDiscState, RestoredFluidGoesOnTheSame) {
    const CoupledSetup setup = settling("interior+boundary");
    CoupledRun run(setup, {disc_at(setup, 2.03, 3.0)});
    for (int n = 0; n < 5; ++n) run.advance();
    const SavedState saved = run.fluid().save();
    const std::vector<GrainState> grains = run.grains();
    const Window next{5, 5 * setup.step, setup.step, false};

    run.fluid().advance(next);
    run.fluid().correct(next, grains);
    const Kicks first = run.fluid().impose(next);
    run.fluid().restore(saved);
    run.fluid().advance(next);
    run.fluid().correct(next, grains);
    const Kicks second = run.fluid().impose(next);
    EXPECT_EQ(first.kicks[0].velocity, second.kicks[0].velocity);
    EXPECT_EQ(first.kicks[0].multiplier_impulse, second.kicks[0].multiplier_impulse);
}

/// Under `joint`, with pressure and excess flux carried from window to window.
TEST(SettlingDiscState, RestoredSplittingsGoOnTheSame) {
    for (const auto& [splitting, time_scheme] : {std::pair{"explicit-multiplier", "first-order"},
                                                 {"implicit-multiplier", "first-order"},
                                                 {"explicit-multiplier", "second-order"}}) {
        CoupledSetup setup = settling("interior+boundary");
        setup.splitting = splitting;
        setup.time_scheme = time_scheme;
        CoupledRun run(setup, {disc_at(setup, 2.03, 3.0)});
        const std::vector<GrainState> grains = run.grains();
        const auto play = [&](int n) {
            const Window window{n, n * setup.step, setup.step, false};
            run.fluid().advance(window);
            run.fluid().let_fall(window, grains);
            run.fluid().correct(window, grains);
            return run.fluid().impose(window);
        };
        for (int n = 0; n < 5; ++n) play(n);
        const SavedState saved = run.fluid().save();
        const Kicks first = play(5);
        run.fluid().restore(saved);
        const Kicks second = play(5);
        ASSERT_TRUE(first.report.splitting) << splitting;
        EXPECT_GT(first.report.splitting->pressure_iterations, 0) << splitting;
        EXPECT_EQ(first.kicks[0].velocity, second.kicks[0].velocity) << splitting;
        EXPECT_EQ(first.kicks[0].multiplier_impulse, second.kicks[0].multiplier_impulse)
            << splitting;
        EXPECT_EQ(first.report.splitting->divergence, second.report.splitting->divergence);
    }
}

}  // namespace
}  // namespace turbidite
