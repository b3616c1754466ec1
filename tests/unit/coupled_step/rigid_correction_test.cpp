// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Pressure and viscosity with rigid grains, each against what defines it.
#include <gtest/gtest.h>

#include "tests/unit/coupled_step/tank.hpp"

namespace turbidite {
namespace {

constexpr IterationLimit to_the_end{400, 1e-7};

class Correction : public testing::TestWithParam<TankSides> {
 protected:
    /// Largest slip at the points of the grains.
    static double slip(Tank& tank) {
        const BoundaryOperator boundary(tank.points());
        std::vector<PlaneVector> u;
        for (const StencilCell& at : tank.points().stencilled)
            u.push_back({tank.step.velocity(0)[at.cell], tank.step.velocity(1)[at.cell]});
        std::vector<double> slip(boundary.rows());
        boundary.apply(u.data(), tank.motions().data(), slip.data());
        double largest = 0.0;
        for (const double s : slip) largest = std::max(largest, std::abs(s));
        return largest;
    }

    /// Largest difference from a rigid motion in the cells inside grains.
    static double deformation(Tank& tank) {
        double largest = 0.0;
        for (int g = 0; g < tank.points().grains(); ++g) {
            const Planar& U = tank.motions()[g];
            for (int i = tank.points().interior_begin[g]; i < tank.points().interior_begin[g + 1];
                 ++i) {
                const InteriorCell& at = tank.points().interior[i];
                largest = std::max(
                    {largest, std::abs(tank.step.velocity(0)[at.cell] - U.x() + U.z() * at.arm_y),
                     std::abs(tank.step.velocity(1)[at.cell] - U.y() - U.z() * at.arm_x)});
            }
        }
        return largest;
    }
};

TEST_P(Correction, PressureEndsSolenoidalAndRigid) {
    for (const double density_ratio : {1.5, 0.4}) {
        Tank tank(GetParam(), 0.01, density_ratio);
        CorrectionWork work;
        RigidPressure pressure(tank.step, work);
        RigidGrains grains = tank.rigid();
        pressure.begin(tank.constraint, time_step, 1.0, {});
        const Planar momentum = tank.momentum();
        const std::vector<Planar> impulses = tank.constraint.flow().impulses();
        EXPECT_GE(pressure.correct(tank.box, grains, to_the_end).iterations, 3);
        for (int round = 0; round < 12; ++round) {
            EXPECT_TRUE(grains.settle().converged);
            EXPECT_TRUE(pressure.correct(tank.box, grains, to_the_end).converged);
        }
        EXPECT_LT(slip(tank), 1e-6);
        EXPECT_LT(deformation(tank), 1e-12);

        pressure.end(tank.box);
        const std::vector<double> r = flux_defect(tank.step);
        EXPECT_LT(std::sqrt(product(r, r) / static_cast<double>(tank.size())), 2e-7);

        // The sides take -dt p; what else the fluid lost is what the grains gained.
        const BoxStep::Force sides = tank.step.pressure_force();
        Planar change = tank.momentum() - momentum;
        for (std::size_t g = 0; g < impulses.size(); ++g)
            change += tank.constraint.flow().impulses()[g] - impulses[g];
        EXPECT_NEAR(change.x(), time_step * sides[0], 1e-10);
        EXPECT_NEAR(change.y(), time_step * sides[1], 1e-10);
    }
}

TEST_P(Correction, PressureGoesOnWhereItStopped) {
    Tank tank(GetParam());
    CorrectionWork work;
    RigidPressure pressure(tank.step, work);
    RigidGrains grains = tank.rigid();
    pressure.begin(tank.constraint, time_step, 1.0, {});
    const IterationResult some = pressure.correct(tank.box, grains, {3, 1e-6});
    EXPECT_EQ(some.iterations, 3);
    EXPECT_FALSE(some.converged);
    EXPECT_TRUE(pressure.correct(tank.box, grains, {200, 1e-6}).converged);
    EXPECT_EQ(pressure.correct(tank.box, grains, {200, 2e-6}).iterations, 0);
}

TEST_P(Correction, WithoutGrainsOneIterationIsExact) {
    Tank tank(GetParam());
    tank.grains.clear();
    tank.place_grains();
    CorrectionWork work;
    RigidPressure pressure(tank.step, work);
    RigidGrains grains = tank.rigid();
    pressure.begin(tank.constraint, time_step, 1.0, {});
    const IterationResult result = pressure.correct(tank.box, grains, {1, 1e-6});
    EXPECT_EQ(result.iterations, 1);
    EXPECT_TRUE(result.converged) << result.residual;
}

/// u = W(s + f) with f = dt nu L u, checked by one constraint from s + f; also where nu dt/h2 is so
/// large that an explicit step would be unstable.
TEST_P(Correction, ViscosityIsImplicit) {
    for (const double viscosity : {0.1, 5.0}) {
        Tank tank(GetParam(), viscosity);
        VelocityRows s;
        s.resize(2, tank.size());
        for (int axis = 0; axis < 2; ++axis)
            std::copy_n(tank.step.velocity(axis), tank.size(), s[axis].begin());
        CorrectionWork work;
        RigidViscosity implicit(work);
        implicit.begin(time_step, viscosity).f.resize(2, tank.size());  // none yet
        RigidGrains grains = tank.rigid();
        const IterationLimit limit{400, 1e-4 * viscosity};  // of accelerations of some 500 nu
        EXPECT_GE(implicit.correct(tank.box, grains, limit).iterations, 2);
        for (int round = 0; round < 6; ++round) {
            EXPECT_TRUE(grains.settle().converged);
            EXPECT_TRUE(implicit.correct(tank.box, grains, limit).converged);
        }
        EXPECT_TRUE(grains.settle().converged);
        EXPECT_LT(deformation(tank), 1e-10);

        VelocityRows f, again;
        f.resize(2, tank.size()), again.resize(2, tank.size());
        for (int axis = 0; axis < 2; ++axis) {
            tank.box.laplacian(viscosity * time_step, axis, tank.step.velocity(axis),
                               f[axis].data());
            for (std::size_t c = 0; c < tank.size(); ++c) {
                EXPECT_NEAR(f[axis][c], implicit.impulse()[axis][c], 1e-3);
                again[axis][c] = s[axis][c] + implicit.impulse()[axis][c];
            }
        }
        // s was rigid already: grains enter with the momentum that they have in it.
        Tank before(GetParam(), viscosity);
        std::vector<ImmersedGrain> grains_before = tank.grains;
        for (std::size_t g = 0; g < grains_before.size(); ++g)
            grains_before[g].contact_motion = twist(before.motions()[g]);
        PlaneConstraint check(tank.field, PointRules{}, Tank::tight());
        check.place(grains_before);
        check.solve({again[0].data(), again[1].data()});
        check.impose();
        for (std::size_t g = 0; g < tank.grains.size(); ++g)
            EXPECT_LT((check.flow().motions()[g] - tank.motions()[g]).norm(), 1e-9);
        for (int axis = 0; axis < 2; ++axis)
            for (std::size_t c = 0; c < tank.size(); ++c)
                ASSERT_NEAR(again[axis][c], tank.step.velocity(axis)[c], 1e-9);
    }
}

TEST_P(Correction, OneIterationAlreadyTakesMostOfTheDivergence) {
    Tank tank(GetParam());
    CorrectionWork work;
    RigidPressure pressure(tank.step, work);
    RigidGrains grains = tank.rigid();
    pressure.begin(tank.constraint, time_step, 1.0, {});
    const double first = pressure.correct(tank.box, grains, {0, 0.0}).residual;
    const double second = pressure.correct(tank.box, grains, {1, 0.0}).residual;
    EXPECT_LT(second, 0.5 * first);
}

INSTANTIATE_TEST_SUITE_P(Sides, Correction, testing::ValuesIn(all_tanks),
                         [](const auto& info) { return name_of(info.param); });

}  // namespace
}  // namespace turbidite
