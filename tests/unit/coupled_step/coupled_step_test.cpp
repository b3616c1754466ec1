// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Whole windows of fluid with grains that keep their places.
#include "fluid_adapter/coupled_step/coupled_step.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "fluid_adapter/box_step/transport/second_order.hpp"

#include "tests/unit/coupled_step/tank.hpp"

namespace turbidite {
namespace {

void transport(Tank& tank, CoupledStep& coupled, double dt) {
    tank.step.hold_solenoidal_flux(dt);
    tank.step.transport(dt, &coupled.begin(dt));
    tank.step.release_flux();
}

/// Transport of second order in time.
class SecondOrderTransport final : private SecondOrderHost {
 public:
    explicit SecondOrderTransport(Tank& tank) : tank_(tank) {}

    void operator()(Tank&, CoupledStep& coupled, double dt) {
        const double courant =
            tank_.step.hold_solenoidal_middle(dt, !second_order_.goes_on()).carried_courant;
        second_order_.transport(*this, dt, SecondOrder::parts(courant, INFINITY));
        tank_.step.add_impulses(second_order_.transported(), coupled.begin(dt));
        tank_.step.release_flux();
    }

 private:
    std::vector<VelocityValues> velocity_values() override {
        return {{tank_.step.velocity(0), tank_.size()}, {tank_.step.velocity(1), tank_.size()}};
    }
    void velocity_changed() override {}
    SideForce play(const VelocityStage& stage) override { return tank_.step.play(stage); }
    SideForce diffuse_implicitly(double) override {
        throw std::logic_error("viscosity belongs to the coupled step");
    }

    Tank& tank_;
    SecondOrder second_order_;
};

/// What a window does between two outputs, without contacts.
template <class Transport>
CoupledReport play(Tank& tank, CoupledStep& coupled, const CoupledLimits& limits, Transport&& move,
                   double dt = time_step) {
    move(tank, coupled, dt);
    coupled.keep_transported();
    for (std::size_t g = 0; g < tank.grains.size(); ++g)
        tank.grains[g].contact_motion = twist(tank.motions()[g]);
    tank.place_grains();
    coupled.place_grains(tank.constraint);
    RigidGrains grains = tank.rigid();
    const CoupledReport report = coupled.correct(grains, limits);
    coupled.end();
    return report;
}

/// explicit-multiplier, with at most so many iterations of viscosity.
CoupledLimits corrected_once(int most = 200) {
    CoupledLimits limits;
    limits.viscosity.most = most;
    return limits;
}

double energy(Tank& tank) {
    double sum = 0.0;
    for (int axis = 0; axis < 2; ++axis)
        for (std::size_t c = 0; c < tank.size(); ++c)
            sum += tank.step.velocity(axis)[c] * tank.step.velocity(axis)[c];
    return sum;
}

class Windows : public testing::TestWithParam<double> {
 protected:
    /// A box of fluid comes to rest whatever nu dt/h2 is, here 0.0064 to 64, though viscosity is
    /// predicted explicitly in time and pressure and viscosity are corrected once.
    template <class Transport>
    void come_to_rest(Tank& tank, Transport&& move) const {
        CoupledStep coupled(tank.step);
        const double begin = energy(tank);
        double before = begin;
        for (int window = 0; window < 50; ++window) {
            const CoupledReport report = play(tank, coupled, corrected_once(), move);
            EXPECT_EQ(report.pressure.iterations, 1);
            EXPECT_GE(report.viscosity.iterations, 1);
            EXPECT_TRUE(report.converged);
            const double now = energy(tank);
            if (window > 0) {
                ASSERT_LT(now, std::max(1.05 * before, 1e-4 * begin)) << "window " << window;
            }
            before = now;
        }
        EXPECT_GT(before, 0.0);
        EXPECT_LT(before, (GetParam() < 1.0 ? 0.3 : 1e-3) * begin);
    }
};

TEST_P(Windows, ThatAreCorrectedOnceAreStable) {
    Tank tank({Side::wall}, GetParam());
    come_to_rest(tank, transport);
}

TEST_P(Windows, WithTransportOfSecondOrderAreStable) {
    Tank tank({Side::wall}, GetParam());
    come_to_rest(tank, SecondOrderTransport(tank));
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
        play(once, coupled_once, corrected_once(), transport);
        EXPECT_TRUE(play(solved, coupled_solved, limits, transport).pressure.converged);
    }
    double largest = 0.0, difference = 0.0;
    for (int axis = 0; axis < 2; ++axis)
        for (std::size_t c = 0; c < once.size(); ++c) {
            const double one = once.step.velocity(axis)[c], other = solved.step.velocity(axis)[c];
            largest = std::max(largest, std::abs(other));
            difference = std::max(difference, std::abs(one - other));
        }
    EXPECT_GT(largest, 1e-3);
    EXPECT_LT(difference, 0.15 * largest);
}

/// Velocity after 0.16 t_c in windows of `dt`, from the end of some windows of first order.
template <class Move>
std::vector<double> later(double dt, Move make) {
    Tank tank({Side::wall}, 1e-3);  // viscosity is of first order
    CoupledStep coupled(tank.step);
    CoupledLimits limits;
    limits.iterated = true;
    limits.viscosity = {400, 1e-6};
    limits.pressure = {400, 1e-6};
    for (int window = 0; window < 40; ++window) play(tank, coupled, limits, transport, 0.005);
    auto&& move = make(tank);
    const int windows = static_cast<int>(std::lround(0.16 / dt));
    for (int window = 0; window < windows; ++window) play(tank, coupled, limits, move, dt);
    std::vector<double> u(tank.step.velocity(0), tank.step.velocity(0) + tank.size());
    u.insert(u.end(), tank.step.velocity(1), tank.step.velocity(1) + tank.size());
    return u;
}

template <class Move>
std::array<double, 2> changes_with_the_step(Move make) {
    const std::array<std::vector<double>, 3> u{later(0.02, make), later(0.01, make),
                                               later(0.005, make)};
    std::array<double, 2> result{};
    for (int pair = 0; pair < 2; ++pair) {
        for (std::size_t c = 0; c < u[0].size(); ++c)
            result[pair] += std::pow(u[pair][c] - u[pair + 1][c], 2);
        result[pair] = std::sqrt(result[pair] / u[0].size());
    }
    return result;
}

/// Steps of twice the length change less with transport of second order, and the error falls
/// faster.
TEST(Window, OfSecondOrderDependsLessOnTheStep) {
    const auto first = changes_with_the_step([](Tank&) { return transport; });
    const auto second =
        changes_with_the_step([](Tank& tank) { return SecondOrderTransport(tank); });
    std::printf("first order %.3g, %.3g; second order %.3g, %.3g\n", first[0], first[1], second[0],
                second[1]);
    EXPECT_LT(second[0], 0.5 * first[0]);
    EXPECT_GT(second[0] / second[1], 2.5);
}

/// nu dt/h2 = 64: two iterations are too few, and the report says so.
TEST(Window, CorrectedOnceTellsThatViscosityUsedUpItsIterations) {
    for (const int most : {2, 200}) {
        Tank tank({Side::wall}, 100.0);
        CoupledStep coupled(tank.step);
        const CoupledReport report = play(tank, coupled, corrected_once(most), transport);
        EXPECT_EQ(report.converged, most == 200);
        EXPECT_EQ(report.viscosity.iterations == most, most == 2);
    }
}

INSTANTIATE_TEST_SUITE_P(Viscosities, Windows, testing::Values(0.01, 0.3, 5.0, 100.0),
                         [](const auto& info) { return "case" + std::to_string(info.index); });

}  // namespace
}  // namespace turbidite
