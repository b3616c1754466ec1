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
#include "fluid_adapter/box_step/second_order.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "fluid_adapter/box_step/box_step.hpp"
#include "fluid_adapter/box_step/transport_parts.hpp"

namespace turbidite {
namespace {

constexpr double pi = 3.14159265358979323846, nu = 0.01, until = 0.5;

struct Choice {
    bool second_order;
    std::optional<double> central;  // else limitedLinearV 1
};
constexpr double lust = 0.75;

class CyclicBox final : public SecondOrderHost {
 public:
    CyclicBox(int n, const Choice& choice)
        : n_(n), choice_(choice), step_(fluid(n, choice)), exact_(2 * n * n) {
        set_exact(0.0);
        for (int axis = 0; axis < 2; ++axis)
            std::copy_n(exact_.data() + axis * n * n, n * n, step_.velocity(axis));
    }

    void play(int windows) {
        const double dt = until / windows;
        for (int window = 0; window < windows; ++window) {
            const double courant = step_.project(dt).courant;
            choice_.second_order ? advance_second_order(dt, courant) : advance(dt, courant);
        }
        step_.project(dt);
    }

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
    SideForce convect(double dt) override {
        step_.transport(dt);
        return step_.convective_force();
    }
    SideForce diffuse_implicitly(double dt) override {
        step_.diffuse(dt, [](int) {});
        return step_.viscous_force();
    }

 private:
    static BoxFluid fluid(int n, const Choice& choice) {
        const AxisOperator axis{n, 1.0 / n, End::periodic, End::periodic};
        BoxFluid fluid;
        fluid.velocity = fluid.pressure = {axis, axis};
        fluid.viscosity = nu;
        fluid.central = choice.central;
        fluid.second_order = choice.second_order;
        return fluid;
    }

    void advance(double dt, double courant) {
        const int parts = transport_parts(courant);
        step_.hold_flux();
        for (int part = 0; part < parts; ++part) step_.transport(dt / parts);
        step_.release_flux();
        diffuse_implicitly(dt);
    }

    void advance_second_order(double dt, double courant) {
        step_.hold_middle_flux(!second_order_.goes_on());
        second_order_.transport(*this, dt, transport_parts(courant, SecondOrder::largest_courant));
        step_.release_flux();
        second_order_.diffuse(*this, dt);
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

    int n_;
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

/// Windows proportional to cells: Courant number about 0.5 at every size.
TEST(SecondOrder, ConvergesWithTheSquareOfStepAndCell) {
    const Choice second{true, lust}, first{false, std::nullopt};
    const double errors[] = {error(16, 32, second), error(32, 64, second), error(64, 128, second)};
    EXPECT_GT(order(errors[0], errors[1]), 1.9);
    EXPECT_GT(order(errors[1], errors[2]), 1.9);
    EXPECT_LT(errors[2], 2e-3);
    const double before[] = {error(32, 64, first), error(64, 128, first)};
    EXPECT_NEAR(order(before[0], before[1]), 1.0, 0.15);
    EXPECT_LT(errors[2], 0.1 * before[1]);
}

TEST(SecondOrder, ConvergesWithEverySchemeForSmoothFlow) {
    for (const double central : {0.0, lust, 1.0}) {
        const Choice choice{true, central};
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
    a.transport(straight, 0.01, 1);
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
