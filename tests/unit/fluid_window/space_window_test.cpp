// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Windows of a fluid in space: a sphere that sinks in a box.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "fluid_adapter/box_app/array_store.hpp"
#include "fluid_adapter/fluid_window/fluid_window.hpp"
#include "tests/run_settings.hpp"

namespace turbidite {
namespace {

constexpr double edge = 1.0 / 8.0;
constexpr double step = 0.01;
constexpr std::array<int, 3> box{24, 32, 28};
constexpr std::array<Side, 3> sides{Side::cyclic, Side::wall, Side::wall};

Settings settings(const std::string& splitting) {
    Settings result = run_settings();
    result.set("run.dimension", std::int64_t{3});
    result.set("domain.left", std::string("cyclic"));
    result.set("domain.right", std::string("cyclic"));
    result.set("domain.front", std::string("wall"));
    result.set("domain.back", std::string("wall"));
    const char* sizes[] = {"run.size_x", "run.size_y", "run.size_z"};
    for (int axis = 0; axis < 3; ++axis) result.set(sizes[axis], box[axis] * edge);
    result.set("run.gravity", 0.0);
    result.set("run.acceleration_z", 0.0);
    result.set("run.surface_shift", 0.3 * edge);
    result.set("fluid.splitting", splitting);
    result.set("fluid.splitting_iterations", std::int64_t{400});
    result.set("fluid.splitting_tolerance", 1e-8);
    return result;
}

ArrayBox fluid_box(const std::string& splitting) {
    ArrayBox result;
    result.grid = grid_of_cubes(box, edge, sides);
    result.viscosity = 0.01;
    result.rigid_grains = splitting != "marchuk-yanenko";
    return result;
}

struct Scene {
    explicit Scene(const std::string& splitting)
        : store(fluid_box(splitting)), window(store, settings(splitting), {{"sphere", {}}}) {
        ball.id = 7;
        ball.radius = 0.5;
        ball.density = 2.0;
        ball.position = {1.513, 2.007, 1.761};
        ball.velocity = {0.05, -0.4, 0.1};
    }

    /// A window in which the sphere stays where it is.
    Kicks play() {
        window.advance({index, static_cast<double>(index) * step, step, false});
        ++index;
        window.correct({ball});
        const Kicks kicks = window.impose();
        ball.velocity = kicks.kicks.at(0).velocity;
        ball.angular_velocity = kicks.kicks.at(0).angular_velocity;
        return kicks;
    }

    ArrayStore store;
    FluidWindow window;
    GrainState ball;
    std::int64_t index = 0;
};

class SpaceWindows : public testing::TestWithParam<std::string> {};

TEST_P(SpaceWindows, MomentumChangesOnlyBySphereAndWalls) {
    Scene scene(GetParam());
    Vec3 together{};  // after an impulsive start those of single windows have either sign
    for (int window = 0; window < 4; ++window) {
        const Kicks kicks = scene.play();
        together = together + kicks.kicks[0].multiplier_impulse;
        EXPECT_LT(kicks.report.momentum_defect, 1e-9) << window;
        EXPECT_TRUE(kicks.report.multipliers_converged);
        EXPECT_EQ(kicks.report.multiplier_iterations, 0) << "the closed form iterates nothing";
    }
    // It moves with (0.05, -0.4, 0.1).
    EXPECT_GT(together[1], 0.01);
    EXPECT_LT(together[2], -0.0025);
}

/// The sphere, twice as dense as the fluid, begins with its velocity in the cells that it covers
/// too, and sets the fluid around it in motion, in every direction: with the added mass C = 1/2 of
/// an infinite fluid, and more in a box; where pressure does not know the sphere, C = 0.
///
///     rho_s V U0 = (rho_s V + C rho_f V(R_h)) U
TEST_P(SpaceWindows, TheSphereSetsTheFluidAroundItInMotion) {
    Scene scene(GetParam());
    const Vec3 before = scene.ball.velocity;
    const Kicks kicks = scene.play();
    const Vec3 after = kicks.kicks.at(0).velocity;
    EXPECT_LT(kicks.report.momentum_defect, 1e-9);
    const double wet = std::pow(1.0 + 2.0 * 0.3 * edge, 3);  // V(R_h)/V
    const bool corrects = GetParam() != "marchuk-yanenko";
    for (int axis = 0; axis < 3; ++axis) {
        const double added = 2.0 * (before[axis] / after[axis] - 1.0) / wet;
        EXPECT_GT(added, corrects ? 0.45 : -1e-9) << axis;
        EXPECT_LT(added, corrects ? 0.80 : 1e-9) << axis;
    }
}

/// A sphere that turns begins with fluid that turns with it, and none that stands still is stirred.
TEST_P(SpaceWindows, SpinAndRestAreBegunWith) {
    Scene turning(GetParam());
    turning.ball.velocity = {};
    turning.ball.angular_velocity = {0.0, 0.3, 0.0};
    EXPECT_GT(turning.play().kicks.at(0).angular_velocity[1], 0.8 * 0.3);
    Scene resting(GetParam());
    resting.ball.velocity = resting.ball.angular_velocity = {};
    EXPECT_EQ(resting.play().kicks.at(0).velocity, Vec3{});
    EXPECT_EQ(resting.store.field().momentum().magnitudes, 0.0);
}

/// What a step remembers beside u and p is all that the next window needs.
TEST_P(SpaceWindows, GoOnFromWhatWasSaved) {
    Scene whole(GetParam()), first(GetParam());
    for (int window = 0; window < 4; ++window) whole.play();
    for (int window = 0; window < 2; ++window) first.play();
    Scene second(GetParam());
    const int cells = second.store.field().owned_cells();
    for (int axis = 0; axis < 3; ++axis)
        std::copy_n(first.store.field().velocity(axis), cells, second.store.field().velocity(axis));
    second.store.step().set_memory(first.store.step().memory());
    second.ball = first.ball;
    second.index = first.index;
    for (int window = 0; window < 2; ++window) second.play();
    EXPECT_EQ(second.ball.velocity, whole.ball.velocity);
    EXPECT_EQ(second.ball.angular_velocity, whole.ball.angular_velocity);
    for (int axis = 0; axis < 3; ++axis)
        for (int c = 0; c < cells; ++c)
            ASSERT_EQ(second.store.field().velocity(axis)[c],
                      whole.store.field().velocity(axis)[c]);
}

/// u = a t everywhere, whatever volume of cells the sphere holds: the force on it is that of the
/// mean pressure gradient, rho_f V a.
TEST_P(SpaceWindows, ANeutralSphereMovesWithADrivenStream) {
    ArrayBox cyclic = fluid_box(GetParam());
    cyclic.grid = grid_of_cubes(box, edge, {Side::cyclic, Side::cyclic, Side::cyclic});
    Settings driven = settings(GetParam());
    for (const char* side : {"bottom", "top", "front", "back"})
        driven.set(std::string("domain.") + side, std::string("cyclic"));
    const Vec3 a{0.5, -0.2, 0.1};
    driven.set("run.acceleration_x", a[0]);
    driven.set("run.acceleration_y", a[1]);
    driven.set("run.acceleration_z", a[2]);
    ArrayStore store(cyclic);
    FluidWindow window(store, driven, {{"sphere", {}}});
    GrainState ball = Scene(GetParam()).ball;
    ball.density = 1.0;
    ball.velocity = {};
    for (int index = 0; index < 4; ++index) {
        window.advance({index, index * step, step, false});
        window.let_fall({ball});
        const Kicks kicks = window.impose();
        ball.velocity = kicks.kicks.at(0).velocity;
        EXPECT_LT(kicks.report.momentum_defect, 1e-9);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(ball.velocity[axis], a[axis] * (index + 1) * step, 1e-12);
            EXPECT_NEAR(kicks.report.mean_velocity[axis], a[axis] * (index + 1) * step, 1e-12);
        }
        EXPECT_LT(kicks.kicks[0].multiplier_impulse[0], 0.0) << "V(R_h) is larger than V";
    }
}

constexpr double a = 2.0;

/// Steady flow along a square duct of side 1 by a body force a along it, nu = 1, between walls
/// above and below, in front and behind:
///     u = 4 a/pi^3 sum_odd 1/n^3 (1 - cosh(n pi s)/cosh(n pi/2)) sin(n pi y),  s = z - 1/2
double duct_velocity(double y, double z) {
    using std::numbers::pi;
    double sum = 0.0;
    for (int n = 1; n < 60; n += 2)
        sum += (1.0 - std::cosh(n * pi * (z - 0.5)) / std::cosh(0.5 * n * pi)) *
               std::sin(n * pi * y) / (n * n * n);
    return 4.0 * a / (pi * pi * pi) * sum;
}

/// Largest error of u at the end of a window, with n cells along both sides.
double error_of_duct(int n, const std::string& splitting, double dt = 0.02) {
    ArrayBox duct;
    const double h = 1.0 / n;
    duct.grid = grid_of_cubes({4, n, n}, h, sides);
    duct.viscosity = 1.0;
    duct.rigid_grains = splitting != "marchuk-yanenko";
    Settings driven = settings(splitting);
    driven.set("run.size_x", 4 * h);
    driven.set("run.size_y", 1.0);
    driven.set("run.size_z", 1.0);
    driven.set("run.viscosity", 1.0);
    driven.set("run.acceleration_x", a);
    driven.set("run.acceleration_y", 0.0);
    ArrayStore store(duct);
    FluidWindow window(store, driven, {{"sphere", {}}});
    for (std::int64_t index = 0; dt * static_cast<double>(index) < 0.6; ++index) {
        window.advance({index, dt * static_cast<double>(index), dt, false});
        window.correct({});
        EXPECT_LT(window.impose().report.momentum_defect, 1e-9);
    }
    double largest = 0.0, error = 0.0;
    for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k) {
            const double exact = duct_velocity((j + 0.5) * h, (k + 0.5) * h);
            const int cell = 4 * (k + n * j);
            largest = std::max(largest, exact);
            error = std::max(error, std::abs(store.field().velocity(0)[cell] - exact));
            EXPECT_NEAR(store.field().velocity(1)[cell], 0.0, 1e-12);
            EXPECT_NEAR(store.field().velocity(2)[cell], 0.0, 1e-12);
        }
    EXPECT_NEAR(largest, 0.0737 * a, 0.003 * a) << "the flow is that of a duct";
    std::printf("square duct, %d cells, dt %g, %s: largest error %.2e of %.4f\n", n, dt,
                splitting.c_str(), error, largest);
    return error;
}

TEST(SquareDuct, FlowConvergesInSecondOrder) {
    const std::string splitting = "implicit-multiplier";
    const double coarse = error_of_duct(8, splitting), fine = error_of_duct(16, splitting);
    EXPECT_LT(fine, 0.3 * coarse);
    EXPECT_LT(fine, 1e-3);
    EXPECT_NEAR(error_of_duct(8, splitting, 0.005), coarse, 1e-5) << "a steady flow has no step";
    // One correction of viscosity does, with nu dt/h2 = 0.13.
    EXPECT_NEAR(error_of_duct(8, "explicit-multiplier", 0.002), coarse, 0.1 * coarse);
}

/// Forces come first and viscosity behind them, so that u is short of a dt/2 at the end of a
/// window.
TEST(SquareDuct, TheSplittingOfThePaperIsShortOfHalfAWindowsForce) {
    for (const double dt : {0.02, 0.01})
        EXPECT_NEAR(error_of_duct(16, "marchuk-yanenko", dt), 0.5 * dt * a, 0.03 * dt * a);
}

INSTANTIATE_TEST_SUITE_P(Splittings, SpaceWindows,
                         testing::Values("marchuk-yanenko", "explicit-multiplier",
                                         "implicit-multiplier"),
                         [](const auto& info) {
                             std::string name = info.param;
                             name[name.find('-')] = '_';
                             return name;
                         });

}  // namespace
}  // namespace turbidite
