// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Orders of a run of steps 1 to 3: a Taylor-Green vortex carried by a uniform stream through a
// cyclic box of edge 1,
//
//     u = 1   - cos(2 pi (x - t)) sin(2 pi (y - t/2)) d,   d = exp(-8 pi2 nu t),  nu = 0.01
//     v = 1/2 + sin(2 pi (x - t)) cos(2 pi (y - t/2)) d
//
// to t = 1/2, where the vortex has moved by half the box and lost a third. Compared after a last
// projection, which is the beginning of the next window.
#include "fluid_adapter/box_step/transport/second_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "fluid_adapter/box_step/box_step.hpp"
#include "fluid_adapter/box_step/transport/transport_parts.hpp"

namespace turbidite {
namespace {

using std::numbers::pi;
constexpr double nu = 0.01, until = 0.5;

struct Choice {
    bool second_order;
    std::optional<double> central;   // else limitedLinearV 1
    bool viscous_transport = false;  // viscosity is part of step 2 where that is possible
};
constexpr double lust = 0.75;

class CyclicBox final : public SecondOrderHost {
 public:
    CyclicBox(int n, const Choice& choice, double viscosity = nu)
        : n_(n), choice_(choice), step_(fluid(n, choice, viscosity)), exact_(2 * n * n) {
        set_exact(0.0);
        for (int axis = 0; axis < 2; ++axis)
            std::copy_n(exact_.data() + axis * n * n, n * n, step_.velocity(axis));
    }

    void play(int windows) {
        const double dt = until / windows;
        for (int window = 0; window < windows; ++window) {
            choice_.second_order ? advance_second_order(dt) : advance(dt);
        }
        step_.project(dt);
    }

    void project(double dt) { step_.project_and_hold_middle(dt, true); }

    std::vector<double> velocity() {
        std::vector<double> u(step_.velocity(0), step_.velocity(0) + n_ * n_);
        u.insert(u.end(), step_.velocity(1), step_.velocity(1) + n_ * n_);
        return u;
    }
    const std::vector<double>& exact() {
        set_exact(until);
        return exact_;
    }

    std::vector<VelocityValues> velocity_values() override {
        const auto size = static_cast<std::size_t>(n_ * n_);
        return {{step_.velocity(0), size}, {step_.velocity(1), size}};
    }
    void velocity_changed() override {}
    int most_parts() const { return most_parts_; }
    double decay(double dt) const { return step_.fastest_decay(dt); }

    /// Adds the shortest wave to u.
    void shake() {
        for (int c = 0; c < n_ * n_; ++c)
            step_.velocity(0)[c] += (c / n_ + c % n_) % 2 == 0 ? 0.1 : -0.1;
    }
    double largest() {
        double result = 0.0;
        for (const double u : velocity()) result = std::max(result, std::abs(u));
        return result;
    }
    SideForce play(const VelocityStage& stage) override { return step_.play(stage); }
    SideForce diffuse_implicitly(double dt) override {
        step_.diffuse(dt, [](int) {});
        return step_.viscous_force();
    }

 private:
    static BoxFluid fluid(int n, const Choice& choice, double viscosity) {
        const AxisOperator axis{n, 1.0 / n, End::periodic, End::periodic};
        BoxFluid fluid;
        fluid.velocity = fluid.pressure = {axis, axis};
        fluid.viscosity = viscosity;
        fluid.central = choice.central;
        fluid.second_order = choice.second_order;
        return fluid;
    }

    void advance(double dt) {
        const int parts = transport_parts(step_.project(dt).courant);
        step_.hold_flux();
        for (int part = 0; part < parts; ++part) step_.transport(dt / parts);
        step_.release_flux();
        diffuse_implicitly(dt);
    }

    void advance_second_order(double dt) {
        const double courant = step_.project_and_hold_middle(dt, !second_order_.goes_on()).courant;
        const double decay = choice_.viscous_transport ? step_.fastest_decay(dt) : INFINITY;
        const double largest = SecondOrder::largest_courant(choice_.central);
        const TransportParts parts = SecondOrder::parts(courant / largest, decay);
        most_parts_ = std::max(most_parts_, parts.count);
        second_order_.transport(*this, dt, parts);
        step_.release_flux();
        if (!parts.viscous) second_order_.diffuse(*this, dt);
    }

    void set_exact(double t) {
        const double d = std::exp(-8.0 * pi * pi * nu * t);
        for (int j = 0; j < n_; ++j)
            for (int i = 0; i < n_; ++i) {
                const double x = 2.0 * pi * ((i + 0.5) / n_ - t);
                const double y = 2.0 * pi * ((j + 0.5) / n_ - 0.5 * t);
                exact_[j * n_ + i] = 1.0 - std::cos(x) * std::sin(y) * d;
                exact_[n_ * n_ + j * n_ + i] = 0.5 + std::sin(x) * std::cos(y) * d;
            }
    }

    int n_, most_parts_ = 0;
    Choice choice_;
    BoxStep step_;
    SecondOrder second_order_;
    std::vector<double> exact_;  // u, then v
};

double rms(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

double error(int n, int windows, const Choice& choice) {
    CyclicBox box(n, choice);
    box.play(windows);
    return rms(box.velocity(), box.exact());
}

/// Of errors e(h) and e(h/2); printed, since how far it is from 2 says more than a bound.
double order(double coarse, double fine) {
    const double result = std::log2(coarse / fine);
    std::printf("errors %.3g and %.3g: order %.2f\n", coarse, fine, result);
    return result;
}

constexpr Choice in_two_steps{true, lust}, in_one_step{true, lust, true}, first_order{};

/// Windows proportional to cells: Courant number about 0.5 at every size. Viscosity in a step of
/// its own, and as part of transport.
TEST(SecondOrder, ConvergesWithTheSquareOfStepAndCell) {
    for (const Choice& second : {in_two_steps, in_one_step}) {
        const double errors[] = {error(16, 32, second), error(32, 64, second),
                                 error(64, 128, second)};
        EXPECT_GT(order(errors[0], errors[1]), 1.9);
        EXPECT_GT(order(errors[1], errors[2]), 1.9);
        EXPECT_LT(errors[2], 2e-3);
        const double before[] = {error(32, 64, first_order), error(64, 128, first_order)};
        EXPECT_NEAR(order(before[0], before[1]), 1.0, 0.15);
        EXPECT_LT(errors[2], 0.1 * before[1]);
    }
}

/// Both ways of viscosity are what they say: they differ, and less and less.
TEST(SecondOrder, ViscosityAsPartOfTransportDiffersBySecondOrder) {
    const auto difference = [](int n, int windows) {
        CyclicBox one(n, in_one_step), two(n, in_two_steps);
        one.play(windows);
        two.play(windows);
        return rms(one.velocity(), two.velocity());
    };
    const double coarse = difference(32, 64), fine = difference(64, 128);
    EXPECT_GT(fine, 1e-8);
    EXPECT_GT(order(coarse, fine), 1.8);
}

/// One more sub-step is the price that viscosity may cost as part of transport.
TEST(SecondOrder, CutsWindowsByCourantNumberAndDecay) {
    const auto cut = [](double courant, double decay, int count, bool viscous) {
        const TransportParts parts = SecondOrder::parts(courant, decay);
        EXPECT_EQ(parts.count, count) << courant << " " << decay;
        EXPECT_EQ(parts.viscous, viscous) << courant << " " << decay;
    };
    cut(0.0, 0.1, 1, true);
    cut(0.9, 0.1, 1, true);
    cut(0.9, 0.3, 2, true);
    cut(1.9, 2.0, 3, true);
    cut(1.9, 2.1, 2, false);
    cut(0.2, 24.0, 1, false);
    cut(std::numeric_limits<double>::quiet_NaN(), 0.1, 1, true);  // refused elsewhere
}

/// Of values all over the rows, of which a direct solve shows the first ones alone.
TEST(BoxStep, ABadPressureIsInTheSumOfTheVelocity) {
    constexpr int n = 16;
    const AxisOperator axis{n, 1.0 / n, End::periodic, End::periodic};
    BoxFluid fluid;
    fluid.velocity = fluid.pressure = {axis, axis};
    BoxStep step(fluid);
    step.keep_pressure();
    ImpulsesOfWindow impulses;
    impulses.dt = 0.1;
    for (const double bad : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
        step.pressure()[n * n - n / 2] = bad;
        std::fill_n(step.velocity(0), step.cells(), 0.5);
        step.hold_solenoidal_flux(impulses.dt);
        step.transport(impulses.dt, &impulses);
        step.release_flux();
        EXPECT_EQ(std::isfinite(impulses.sum_u), bad == 0.0) << impulses.sum_u;
    }
    EXPECT_TRUE(std::isfinite(step.velocity(0)[0])) << "one that tests nothing";
}

/// A stream that sets in at once is carried by the flux of the window's middle, 3/2 of its own; in
/// the next window by its own.
TEST(SecondOrder, TellsTheCourantNumberOfTheFluxThatIsCarried) {
    constexpr int n = 16;
    constexpr double dt = 1.2 / n;
    const AxisOperator axis{n, 1.0 / n, End::periodic, End::periodic};
    BoxFluid fluid;
    fluid.velocity = fluid.pressure = {axis, axis};
    fluid.second_order = true;
    for (const bool rigid_grains : {false, true}) {
        BoxStep step(fluid);
        const auto stream = [&](double u, bool begins) {
            std::fill_n(step.velocity(0), step.cells(), u);
            return rigid_grains ? step.hold_solenoidal_middle(dt, begins)
                                : step.project_and_hold_middle(dt, begins);
        };
        stream(0.0, true);
        const FluxReport sets_in = stream(1.0, false), goes_on = stream(1.0, false);
        EXPECT_NEAR(sets_in.courant, 1.2, 1e-12);
        EXPECT_NEAR(sets_in.carried_courant, 1.8, 1e-12);
        EXPECT_NEAR(goes_on.carried_courant, 1.2, 1e-12);
    }
}

TEST(SecondOrder, KnowsTheStableCourantNumberOfAScheme) {
    EXPECT_EQ(SecondOrder::largest_courant(1.0), 1.5);   // linear: 1.73
    EXPECT_EQ(SecondOrder::largest_courant(lust), 1.5);  // 1.91
    EXPECT_EQ(SecondOrder::largest_courant(0.0), 1.0);   // linearUpwind: 1.17
    EXPECT_EQ(SecondOrder::largest_courant(std::nullopt), 1.0);
}

/// At the largest Courant number that a sub-step may have, along a diagonal, nothing grows: the
/// shortest waves on a stream that meets no viscosity.
TEST(SecondOrder, IsStableAtItsCourantNumber) {
    for (const double central : {0.0, lust, 1.0}) {
        CyclicBox box(32, {true, central, true}, 1e-9);
        const double largest = SecondOrder::largest_courant(central);
        const int windows = static_cast<int>(std::ceil(until * 4.0 * 32.0 / largest));  // |u| + |v|
        box.shake();
        const double before = box.largest();
        EXPECT_EQ(SecondOrder::parts(1.0 - 1e-9, 0.0).count, 1);
        box.play(windows);
        EXPECT_LT(box.largest(), 1.2 * before) << central;
        EXPECT_LE(box.most_parts(), 2) << central;
    }
}

/// The largest cut that parts allows does not grow, in the shortest waves either.
TEST(SecondOrder, IsStableWithAsMuchViscosityAsTransportTakes) {
    CyclicBox box(32, in_one_step);
    const int windows = 24;  // a decay of 1.7 each
    ASSERT_TRUE(SecondOrder::parts(1.0, box.decay(until / windows)).viscous);
    EXPECT_GT(box.decay(until / windows), 1.5);
    box.shake();
    const double before = box.largest();
    box.play(windows);
    EXPECT_LT(box.largest(), before);
}

TEST(SecondOrder, ConvergesWithEverySchemeForSmoothFlow) {
    for (const double central : {0.0, lust, 1.0}) {
        const Choice choice{true, central, true};
        const double coarse = error(32, 64, choice), fine = error(64, 128, choice);
        EXPECT_GT(order(coarse, fine), 1.9) << central;
        EXPECT_LT(fine, 3e-3) << central;
    }
}

/// Differences between runs that differ in their step alone, which transport divides into
/// sub-steps: up to a Courant number of 5 a window.
TEST(SecondOrder, ConvergesInTimeAlone) {
    const auto differences = [](const Choice& choice) {
        std::vector<std::vector<double>> u;
        for (const int windows : {16, 32, 64}) {
            CyclicBox box(64, choice);
            box.play(windows);
            u.push_back(box.velocity());
        }
        return std::array<double, 2>{rms(u[0], u[1]), rms(u[1], u[2])};
    };
    const auto second = differences({true, lust}), first = differences({false, lust});
    EXPECT_GT(order(second[0], second[1]), 1.7);
    EXPECT_LT(order(first[0], first[1]), 1.3);
    EXPECT_LT(second[1], 0.25 * first[1]);
}

/// What a window remembers is all it needs to go on.
TEST(SecondOrder, GoesOnFromItsMemory) {
    CyclicBox straight(16, {true, lust});
    SecondOrder a, b;
    straight.play(3);
    straight.project(0.01);
    a.transport(straight, 0.01, {});
    std::vector<double> memory;
    a.append_memory(straight, memory);
    ASSERT_EQ(memory.size(), 1u + 2 * 16 * 16);
    EXPECT_EQ(memory[0], 1.0);
    EXPECT_FALSE(b.goes_on());
    b.set_memory(straight, memory.data());
    EXPECT_TRUE(b.goes_on());
    std::vector<double> again;
    b.append_memory(straight, again);
    EXPECT_EQ(memory, again);
}

}  // namespace
}  // namespace turbidite
