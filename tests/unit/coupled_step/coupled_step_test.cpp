// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Whole windows of fluid with grains that keep their places.
#include "fluid_adapter/coupled_step/coupled_step.hpp"

#include <gtest/gtest.h>

#include "tests/unit/coupled_step/tank.hpp"

namespace turbidite {
namespace {

/// What a window does between two outputs, without contacts.
CoupledReport play(Tank& tank, CoupledStep& coupled, const CoupledLimits& limits) {
    tank.step.hold_solenoidal_flux(time_step);
    tank.step.transport(time_step, &coupled.begin(time_step));
    tank.step.release_flux();
    coupled.keep_transported();
    std::vector<Planar> momenta;
    for (std::size_t g = 0; g < tank.grains.size(); ++g) {
        const ImmersedGrain& grain = tank.grains[g];
        momenta.push_back(
            Planar(grain.effective_mass, grain.effective_mass, grain.effective_inertia)
                .cwiseProduct(tank.flow.motions()[g]));
    }
    tank.flow.begin(tank.system, tank.velocity(), momenta, prescribed_motions(tank.grains));
    uzawa_cg(tank.flow, tank.settings, tank.work);
    tank.flow.impose();
    coupled.place_grains(tank.points);
    RigidGrains grains = tank.rigid();
    const CoupledReport report = coupled.correct(grains, limits);
    coupled.end();
    return report;
}

double energy(Tank& tank) {
    double sum = 0.0;
    for (int axis = 0; axis < 2; ++axis)
        for (std::size_t c = 0; c < tank.size(); ++c)
            sum += tank.step.velocity(axis)[c] * tank.step.velocity(axis)[c];
    return sum;
}

class Windows : public testing::TestWithParam<double> {};

/// A box of fluid comes to rest whatever nu dt/h2 is, here 0.0064 to 64, though viscosity is
/// predicted explicitly in time and pressure and viscosity are corrected once.
TEST_P(Windows, ThatAreCorrectedOnceAreStable) {
    Tank tank({Side::wall}, GetParam());
    CoupledStep coupled(tank.step);
    const double begin = energy(tank);
    double before = begin;
    for (int window = 0; window < 50; ++window) {
        const CoupledReport report = play(tank, coupled, {});
        EXPECT_EQ(report.pressure.iterations, 1);
        EXPECT_GE(report.viscosity.iterations, 1);
        const double now = energy(tank);
        if (window > 0) {
            ASSERT_LT(now, std::max(1.05 * before, 1e-4 * begin)) << "window " << window;
        }
        before = now;
    }
    EXPECT_GT(before, 0.0);
    EXPECT_LT(before, (GetParam() < 1.0 ? 0.3 : 1e-3) * begin);
}

/// What is carried and corrected once, window after window, follows what is solved in each.
TEST(Window, CorrectedOnceFollowsTheSolved) {
    constexpr double viscosity = 1.0;  // nu dt/h2 = 0.64
    Tank once({Side::wall}, viscosity), solved({Side::wall}, viscosity);
    CoupledStep coupled_once(once.step), coupled_solved(solved.step);
    CoupledLimits limits;
    limits.iterated = true;
    limits.viscosity = {400, 1e-4};
    limits.pressure = {400, 1e-5};
    for (int window = 0; window < 10; ++window) {
        play(once, coupled_once, {});
        EXPECT_TRUE(play(solved, coupled_solved, limits).pressure.converged);
    }
    double largest = 0.0, difference = 0.0;
    for (int axis = 0; axis < 2; ++axis)
        for (std::size_t c = 0; c < once.size(); ++c) {
            const double one = once.step.velocity(axis)[c], other = solved.step.velocity(axis)[c];
            largest = std::max(largest, std::abs(other));
            difference = std::max(difference, std::abs(one - other));
        }
    EXPECT_GT(largest, 1e-3);
    EXPECT_LT(difference, 0.1 * largest);
}

INSTANTIATE_TEST_SUITE_P(Viscosities, Windows, testing::Values(0.01, 0.3, 5.0, 100.0),
                         [](const auto& info) { return "case" + std::to_string(info.index); });

}  // namespace
}  // namespace turbidite
