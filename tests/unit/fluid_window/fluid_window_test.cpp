// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Windows of the fluid in plain arrays: a disc that sinks in a box, whose analytic answer is the
// balance of momentum.
#include "fluid_adapter/fluid_window/fluid_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/run_settings.hpp"
#include "tests/unit/fluid_window/watched_store.hpp"

namespace turbidite {
namespace {

constexpr int cells = 48;
constexpr double edge = 1.0 / 8.0;
constexpr double step = 0.01;

Settings settings(const std::string& splitting) {
    Settings result = run_settings();
    result.set("run.slip_tolerance", 1e-10);
    result.set("run.gravity", 0.0);
    result.set("fluid.points", std::string("interior+boundary"));
    result.set("fluid.point_spacing", 1.5);
    result.set("fluid.multiplier_iterations", std::int64_t{200});
    result.set("fluid.splitting", splitting);
    result.set("fluid.splitting_iterations", std::int64_t{400});
    result.set("fluid.splitting_tolerance", 1e-8);
    return result;
}

Settings in_gravity(const std::string& splitting, double gravity) {
    Settings result = settings(splitting);
    result.set("run.gravity", gravity);
    return result;
}

GrainState sinking_disc() {
    GrainState state;
    state.id = 7;
    state.radius = 0.5;
    state.density = 1.5;
    state.position = {3.013, 3.007, 0.0};
    state.velocity = {0.05, -0.4, 0.0};
    return state;
}

Window window_at(std::int64_t index, bool output = false) {
    return {index, static_cast<double>(index) * step, step, output};
}

struct Scene {
    explicit Scene(const std::string& splitting = "marchuk-yanenko", double gravity = 0.0)
        : store(cells, edge, 0.01, splitting != "marchuk-yanenko"),
          window(store, in_gravity(splitting, gravity), {{"disc", {}}}) {}

    /// A window in which the disc is where and as fast as it was.
    Kicks play(std::int64_t index, bool output = false) {
        window.advance(window_at(index, output));
        window.correct({disc});
        return window.impose();
    }
    /// The same, in which it falls freely.
    Kicks fall(std::int64_t index) {
        window.advance(window_at(index));
        window.let_fall({disc});
        return window.impose();
    }

    WatchedStore store;
    FluidWindow window;
    GrainState disc = sinking_disc();
};

class EverySplitting : public testing::TestWithParam<std::string> {};

bool corrects(const std::string& splitting) {
    return splitting != "marchuk-yanenko";
}

TEST_P(EverySplitting, MomentumChangesOnlyByDiscAndWalls) {
    Scene scene(GetParam());
    for (int index = 0; index < 3; ++index) {
        const Kicks kicks = scene.play(index);
        ASSERT_EQ(kicks.kicks.size(), 1u);
        EXPECT_EQ(kicks.kicks[0].id, 7);
        EXPECT_GT(kicks.kicks[0].multiplier_impulse[1], 0.0) << "the fluid does not hold the disc";
        EXPECT_LT(kicks.report.momentum_defect, 1e-9) << index;
        EXPECT_TRUE(kicks.report.multipliers_converged);
        scene.disc.velocity = kicks.kicks[0].velocity;
    }
}

/// The disc, 1.5 times as dense as the fluid, begins with its velocity in the cells that it covers
/// too, and sets the fluid around it in motion:
///
///     rho_s V U0 = (rho_s + C rho_f) V U
///
/// with the added mass of that fluid, C = 1 in an infinite one and more in a box, where pressure
/// knows the disc; without it C = 0.
TEST_P(EverySplitting, TheDiscSetsTheFluidAroundItInMotion) {
    Scene scene(GetParam());
    scene.disc.angular_velocity[2] = 0.3;
    const Kick kick = scene.play(0).kicks.at(0);
    const double added = 1.5 * scene.disc.velocity[1] / kick.velocity[1] - 1.5;
    EXPECT_GT(added, corrects(GetParam()) ? 1.0 : -0.01);
    EXPECT_LT(added, corrects(GetParam()) ? 1.6 : 0.01);
    // No pressure turns a disc; viscosity takes some of the spin.
    EXPECT_NEAR(kick.angular_velocity[2], 0.3, 0.2 * 0.3);
    const int centre = scene.store.field().cell(24, 24, 0);
    const double along = 24.5 * edge - scene.disc.position[0];
    const double of_disc = kick.velocity[1] + along * kick.angular_velocity[2];
    EXPECT_NEAR(scene.store.field().velocity(1)[centre], of_disc, 1e-9);
}

/// A disc whose velocity comes with its weight of the window, as under `split`, begins as one whose
/// velocity comes without, as under `joint`: at rest it carries no fluid along.
TEST(FluidWindow, BeginsAlikeBeforeAndAfterContacts) {
    constexpr double gravity = 2.0, submerged = 0.5,
                     excess = 0.5;  // (rho_s - rho_f)/rho_f, R_h = R
    Settings heavy = settings("marchuk-yanenko");
    heavy.set("run.gravity", gravity);
    for (const double fall : {0.0, -0.4}) {
        WatchedStore before(cells, edge, 0.01, false), after(cells, edge, 0.01, false);
        FluidWindow falls(before, heavy, {{"disc", {}}}), corrected(after, heavy, {{"disc", {}}});
        GrainState disc = sinking_disc();
        disc.velocity = {0.0, fall, 0.0};
        falls.advance(window_at(0));
        falls.let_fall({disc});
        const Kick free = falls.impose().kicks.at(0);
        // cM (U^{n+4/5} - U^n) = (M - m_f) g dt + J
        constexpr double impulse = 0.003;
        disc.contact_impulse = {impulse, 0.0, 0.0};
        disc.velocity[1] -= submerged / excess * gravity * step;
        disc.velocity[0] += impulse / (excess * 0.25 * M_PI);
        corrected.advance(window_at(0));
        corrected.correct({disc});
        const Kick constrained = corrected.impose().kicks.at(0);
        EXPECT_NEAR(constrained.velocity[1], free.velocity[1], 1e-7) << fall;
        // J moves the disc with all of its mass, and the cells that its points reach.
        const double whole = impulse / (1.5 * 0.25 * M_PI);
        EXPECT_NEAR(constrained.velocity[0] / whole, 0.9, 0.1) << fall;
    }
}

constexpr int never = -1;

struct Beginning {
    Vec3 velocity{};  // of the disc
    MovedSides sides;
};

/// Velocity of a disc that falls, after three windows of which all rates of change are forgotten
/// after one.
Vec3 after_three(const std::string& splitting, int forgotten, const Beginning& begins) {
    Scene scene(splitting, 1.0);
    scene.disc.velocity = begins.velocity;
    scene.store.sides = begins.sides;
    for (int index = 0; index < 3; ++index) {
        scene.disc.velocity = scene.fall(index).kicks.at(0).velocity;
        if (index == forgotten) scene.window.velocity_changed();
    }
    return scene.disc.velocity;
}

/// The fluid is set in motion at once: the second window does not go on at that rate, the third
/// one goes on at that of the second.
TEST_P(EverySplitting, TheFirstJumpIsNoRateOfChange) {
    const Beginning falling{{0.5, -2.0, 0.0}, {}};
    const Vec3 velocity = after_three(GetParam(), never, falling);
    EXPECT_EQ(after_three(GetParam(), 0, falling), velocity);
    EXPECT_NE(after_three(GetParam(), 1, falling), velocity);
}

/// Where pressure is corrected after transport, that of an inflow is such a jump too; step 1 of
/// marchuk-yanenko has made it before.
TEST_P(EverySplitting, TheJumpOfAnInflowIsNoRateOfChange) {
    const Beginning flowing{{}, {true, 1.0}};
    const Vec3 velocity = after_three(GetParam(), never, flowing);
    EXPECT_EQ(after_three(GetParam(), 0, flowing) == velocity, corrects(GetParam()));
    EXPECT_NE(after_three(GetParam(), 1, flowing), velocity);
}

/// The pressure of the jump is gone with its window, and the next one finds its own: all of it,
/// where a single iteration would do with a pressure to begin with.
TEST(FluidWindow, PressureAfterAJumpIsFoundAnew) {
    std::array<std::array<double, 4>, 2> drag;
    for (const int splitting : {0, 1}) {
        Scene scene(splitting == 0 ? "explicit-multiplier" : "implicit-multiplier");
        scene.disc.prescribed = true;
        for (int index = 0; index < 4; ++index) {
            const Kick kick = scene.play(index).kicks.at(0);
            drag[splitting][index] = kick.multiplier_impulse[1] / step;
            scene.disc.position[1] += step * scene.disc.velocity[1];
        }
    }
    for (int index = 1; index < 4; ++index)
        EXPECT_NEAR(drag[0][index] / drag[1][index], 1.0, 0.05) << index;
}

/// Walls that slide along themselves, and sides whose motion has not begun, push no fluid.
TEST_P(EverySplitting, SidesThatLetNothingInAreNoJump) {
    MovedSides sides;
    EXPECT_FALSE(sides.any);
    sides.add(2, {});                // bottom
    sides.add(3, {0.7, 0.0, -0.2});  // top
    EXPECT_TRUE(sides.any);
    EXPECT_EQ(sides.through, 0.0);
    EXPECT_EQ(after_three(GetParam(), never, {{}, sides}), after_three(GetParam(), never, {}));
    sides.add(5, {0.0, 0.0, -0.3});
    EXPECT_EQ(sides.through, 0.3);
}

/// Where no direct solve spreads it.
TEST_P(EverySplitting, ABadValueAnywhereEndsTheRunBeforeStep5) {
    if (!corrects(GetParam())) return;
    Scene scene(GetParam());
    scene.play(0);
    scene.store.field().velocity(1)[cells * cells - 1] = NAN;
    try {
        scene.window.advance(window_at(1));
        FAIL() << "nobody has noticed";
    } catch (const Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find("steps 1-3"), std::string::npos)
            << failure.what();
    }
}

/// Div u = 0 in a closed box: what goes down in the disc comes up around it.
TEST_P(EverySplitting, OnlyACorrectedPressureLetsTheFluidGoRound) {
    Scene scene(GetParam());
    const Kick kick = scene.play(0).kicks.at(0);
    const double of_disc = 0.25 * M_PI * kick.velocity[1];
    const double together = scene.store.field().momentum().sum[1] / of_disc;
    if (corrects(GetParam()))
        EXPECT_LT(std::abs(together), 0.1);
    else
        EXPECT_GT(together, 1.0);
}

/// A vortex that a stream carries through a cyclic box, after a time, in windows of this length.
std::vector<double> carried_vortex(const std::string& splitting, int windows) {
    constexpr int n = 32;
    constexpr double h = 2.0 * M_PI / n, end = 0.6;
    WatchedStore store(n, h, 0.01, corrects(splitting), Side::cyclic);
    FluidWindow window(store, settings(splitting), {{"disc", {}}});
    for (int c = 0; c < n * n; ++c) {
        const double x = (c % n + 0.5) * h, y = (c / n + 0.5) * h;
        store.field().velocity(0)[c] = 1.0 + std::sin(x) * std::cos(y) + 0.5 * std::cos(2.0 * y);
        store.field().velocity(1)[c] = 0.3 - std::cos(x) * std::sin(y);
    }
    const double dt = end / windows;
    for (int index = 0; index < windows; ++index) {
        window.advance({index, index * dt, dt, false});
        window.correct({});
        window.impose();
    }
    const double* u = store.field().velocity(0);
    return {u, u + n * n};
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t c = 0; c < a.size(); ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

/// With the flux of the middle of a window; with that of its beginning errors would halve only. The
/// paper's splitting is of first order, whatever transport is.
TEST_P(EverySplitting, WithoutGrainsWindowsOfCorrectedPressureAreOfSecondOrder) {
    const std::vector<double> exact = carried_vortex(GetParam(), 240);
    const double of_long = distance(carried_vortex(GetParam(), 15), exact);
    const double of_half = distance(carried_vortex(GetParam(), 30), exact);
    EXPECT_GT(of_long, 1e-5);
    if (corrects(GetParam()))
        EXPECT_NEAR(of_long / of_half, 4.0, 0.6) << of_long << " and " << of_half;
    else
        EXPECT_NEAR(of_long / of_half, 2.0, 0.3) << of_long << " and " << of_half;
}

/// Mean velocity of the stream that a body force drives along an array of fixed discs, when it is
/// steady; Re = 16 or so.
double steady_stream(const std::string& splitting, double dt) {
    constexpr int n = 12;
    constexpr double side = n * edge, end = 16.0;
    WatchedStore store(n, edge, 0.05, true, Side::cyclic);
    Settings driven = settings(splitting);
    for (const char* name : {"left", "right", "bottom", "top"})
        driven.set(std::string("domain.") + name, std::string("cyclic"));
    driven.set("run.size_x", side);
    driven.set("run.size_y", side);
    driven.set("run.acceleration_x", 3.0);
    FluidWindow window(store, driven, {{"disc", {}}});
    GrainState fixed = sinking_disc();
    fixed.position = {0.5 * side + 0.013, 0.5 * side + 0.007, 0.0};
    fixed.velocity = {};
    fixed.prescribed = true;
    double mean = 0.0, before = 0.0;
    for (std::int64_t index = 0; dt * static_cast<double>(index) < end; ++index) {
        window.advance({index, dt * static_cast<double>(index), dt, false});
        window.correct({fixed});
        before = mean;
        mean = window.impose().report.mean_velocity[0];
    }
    EXPECT_NEAR(mean, before, 1e-6 * mean) << "it is not steady";
    return mean;
}

/// Convection carries the velocity of the flow, without what the force adds in a window.
TEST(FluidWindow, ASteadyStreamDoesNotDependOnTheStep) {
    for (const char* splitting : {"explicit-multiplier", "implicit-multiplier"}) {
        const double of_short = steady_stream(splitting, 0.005);
        EXPECT_GT(of_short, 0.4);
        EXPECT_NEAR(steady_stream(splitting, 0.02) / of_short, 1.0, 1e-8) << splitting;
    }
}

/// A gate of 4 cells that leaves the floor: the cells between it and the floor are its own, and no
/// pressure can fill them before there is a cell of fluid.
TEST_P(EverySplitting, AGateLeavesTheFloor) {
    constexpr double up = 0.5;
    WatchedStore store(cells, edge, 0.01, corrects(GetParam()));
    Settings with_gate = settings(GetParam());
    // Its lower end is the middle of the half disc that ends it.
    with_gate.set("run.walls", std::string("4 3 0 3 3 0 0.5 0 0 0 0 0.5"));
    FluidWindow window(store, with_gate, {{"disc", {}}});
    FluidReport report;
    double fastest = 0.0;
    for (int index = 0; index < 40; ++index) {
        window.advance(window_at(index));
        window.correct({});
        report = window.impose().report;
        for (int axis = 0; axis < 2; ++axis)
            for (int c = 0; c < cells * cells; ++c)
                fastest = std::max(fastest, std::abs(store.field().velocity(axis)[c]));
        ASSERT_LT(fastest, 20.0 * up) << "window " << index;
    }
    EXPECT_GE(fastest, up);
    EXPECT_LT(report.momentum_defect, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(, EverySplitting,
                         testing::Values("marchuk-yanenko", "explicit-multiplier",
                                         "implicit-multiplier"),
                         [](const auto& info) {
                             return info.param.substr(0, info.param.find('-'));
                         });

TEST(FluidWindow, FieldsFollowOnlyForThoseWhoLook) {
    Scene scene;
    scene.play(0);
    scene.play(1);
    EXPECT_EQ(scene.store.fluxes, 0);
    scene.play(2, true);
    EXPECT_EQ(scene.store.fluxes, 1);
    EXPECT_EQ(scene.store.written, 1u);
    scene.store.looks = true;
    for (int window = 3; window < 5; ++window) {
        scene.play(window);
        EXPECT_EQ(scene.store.shown, window - 2) << "once in every window";
        EXPECT_EQ(scene.store.fluxes, window - 1);
        EXPECT_NE(scene.store.shown_x, 0.0);
        EXPECT_EQ(scene.store.shown_x, scene.store.field().velocity(0)[0]) << "of its end";
    }
}

/// A stream that sets in at once, with a Courant number of 1.2: its window carries it with 3/2 of
/// it, of which LUST bears 1.5 in one part.
TEST(FluidWindow, PartsOfTransportBearTheFluxThatIsCarried) {
    for (const char* splitting : {"marchuk-yanenko", "explicit-multiplier"}) {
        WatchedStore store(cells, edge, 0.01, corrects(splitting), Side::cyclic);
        FluidWindow window(store, settings(splitting), {{"disc", {}}});
        for (std::int64_t index = 0; index < 3; ++index) {
            std::fill_n(store.field().velocity(0), store.field().owned_cells(),
                        index > 0 ? 1.2 * edge / step : 0.0);
            window.advance(window_at(index, true));
            window.correct({});
            const double courant = window.impose().report.courant;
            EXPECT_NEAR(courant, index > 0 ? 1.2 : 0.0, 1e-9) << "that of the velocity";
            const std::string expected =
                index == 1 ? "transport in 2 parts" : "transport in 1 parts";
            EXPECT_NE(store.lines.back().find(expected), std::string::npos) << store.lines.back();
        }
    }
}

TEST(FluidWindow, AGrainThatReachesStretchedRowsIsRefused) {
    WatchedStore store(cells, edge, 0.01, false);
    store.resolved_height = 3.0;
    Settings strict = settings("marchuk-yanenko");
    strict.set("fluid.allow_coarse", false);
    FluidWindow window(store, strict, {{"disc", {}}});
    window.advance(window_at(0));
    try {
        window.correct({sinking_disc()});
        FAIL() << "not refused";
    } catch (const PhysicsRefused& refused) {
        EXPECT_NE(std::string(refused.what()).find("grain 7 reaches y = 3.507 D"),
                  std::string::npos)
            << refused.what();
    }
}

TEST(FluidWindow, AVelocityThatIsNoNumberIsRefusedByTheStepThatFindsIt) {
    Scene scene;
    scene.store.field().velocity(0)[100] = NAN;
    try {
        scene.window.advance(window_at(0));
        FAIL() << "not refused";
    } catch (const PhysicsRefused& refused) {
        EXPECT_EQ(std::string(refused.what()),
                  "steps 1-3 (projection, transport, viscosity) of window 0: the fluid velocity is "
                  "not finite; use a smaller time.step");
    }
}

}  // namespace
}  // namespace turbidite
