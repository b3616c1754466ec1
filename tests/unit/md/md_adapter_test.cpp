// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/md/md_adapter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "granular_adapter/grains/case_bodies.hpp"
#include "granular_adapter/md/first_positions.hpp"
#include "granular_adapter/nscd_adapter/nscd_adapter.hpp"
#include "tests/unit/md/leap_frog_host.hpp"
#include "tests/unit/nscd_adapter/contact_case.hpp"

namespace turbidite {
namespace {

const ShapeTable discs = {{"disc", {}}};
constexpr double dt = 0.01;
constexpr double area = std::numbers::pi / 4.0;

// The box, with windows of 0.01 in 8 sub-steps each.
Settings md_settings() {
    Settings settings = box_settings();
    settings.set("coupling.md_hold", true);
    settings.set("run.step", dt);
    settings.set("run.md_substeps", std::int64_t{8});
    return settings;
}

nscd::Wall floor_at_zero() {
    nscd::Wall wall;
    wall.key = 2;
    wall.normal = {0.0, 1.0, 0.0};
    return wall;
}

Window window(std::int64_t index, bool output = false) {
    return {index, static_cast<double>(index) * dt, dt, output};
}

Kick kick_of(GrainId id, const Vec3& velocity, double spin, const Vec3& impulse, double moment) {
    Kick kick;
    kick.id = id;
    kick.velocity = velocity;
    kick.angular_velocity = {0.0, 0.0, spin};
    kick.multiplier_impulse = impulse;
    kick.multiplier_angular_impulse = {0.0, 0.0, moment};
    return kick;
}

/// A fluid whose only known property is that it changes with time.
Kick some_kick(GrainId id, std::int64_t n) {
    const double t = static_cast<double>(n);
    return kick_of(id, {0.3 * std::sin(t), -0.2 - 0.1 * std::cos(t), 0.0}, std::sin(2.0 * t),
                   {0.01 * std::cos(t), 0.004 * t, 0.0}, 0.002 * std::cos(t));
}

template <class Error>
std::string refusal(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    ADD_FAILURE() << "nothing was refused";
    return {};
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// A disc that parts from the floor at a gap of 0.001, from which half a window takes it back by
/// 0.01.
GrainState parting() {
    GrainState grain = grain_at(7, 5.0, 0.501);
    grain.velocity = {0.1, 2.0, 0.0};
    grain.angular_velocity = {0.0, 0.0, 1.0};
    return grain;
}

TEST(FirstPositions, WhatPartsFromAWallIsWhereTheCaseSaysAndKeepsItsVelocity) {
    LeapFrogHost host;
    MdAdapter adapter("yade-md", host);
    Settings settings = md_settings();
    settings.set("fluid.enabled", false);
    const GrainState start = adapter.initialise(settings, discs, {parting()}).grains[0];
    EXPECT_EQ(start.position, parting().position);
    EXPECT_EQ(start.orientation, parting().orientation);
    const Motion motion = adapter.advance(window(0), {});
    EXPECT_EQ(motion.grains[0].position, parting().position);
    EXPECT_EQ(motion.report.contacts, 0);
    EXPECT_EQ(motion.report.max_penetration, 0.0);
    const GrainState once = adapter.apply_kick(window(0), {}).grains[0];
    EXPECT_NEAR(once.velocity[1], 2.0 - dt, 1e-12);  // g = 1
    // A window, and the half of one that it is ahead; with the lag of leap-frog, 7/16.
    EXPECT_NEAR(once.position[0], 5.0 + 0.1 * dt * (1.0 + 7.0 / 16.0), 1e-12);
    // From then on as all others: q <- q + dt U.
    adapter.advance(window(1), {});
    const GrainState twice = adapter.apply_kick(window(1), {}).grains[0];
    EXPECT_NEAR(twice.position[0], once.position[0] + 0.1 * dt, 1e-12);
}

TEST(FirstPositions, WhatComesOrIsAloneBeginsHalfAWindowBehind) {
    const RunValues run = run_values(md_settings());
    for (const auto& [y, speed] : {std::pair{0.501, -2.0}, std::pair{3.0, 2.0}}) {
        GrainState grain = parting();
        grain.position[1] = y, grain.velocity[1] = speed;
        nscd::Bodies bodies;
        add_grains(bodies, run, discs, {grain});
        const auto stays = take_first_positions(bodies, 0.005, run, discs, {floor_at_zero()});
        EXPECT_EQ(stays[0], 0);
        EXPECT_NEAR(bodies.position[0][1], y - 0.005 * speed, 1e-15);
    }
}

// The one that parts from the floor stays, so that the next one would begin in it, and stays too.
TEST(FirstPositions, WhoWouldBeginInOneThatStaysStaysToo) {
    const RunValues run = run_values(md_settings());
    GrainState next = parting(), far = parting();
    next.id = 8, next.position[1] += 1.001;
    far.id = 9, far.position[0] += 3.0, far.position[1] += 3.0;
    nscd::Bodies bodies;
    add_grains(bodies, run, discs, {parting(), next, far});
    const auto stays = take_first_positions(bodies, 0.005, run, discs, {floor_at_zero()});
    EXPECT_EQ(stays, (std::vector<std::uint8_t>{1, 1, 0}));
    EXPECT_EQ(bodies.position[1], next.position);
}

/// One grain driven by an MdAdapter.
struct Single {
    explicit Single(const Settings& settings, double y = 10.0) : adapter("yade-md", host) {
        adapter.initialise(settings, discs, {grain_at(7, 5.0, y)});
    }
    LeapFrogHost host;
    MdAdapter adapter;
};

class HeldOrNot : public testing::TestWithParam<bool> {
 protected:
    static Settings settings() {
        Settings settings = md_settings();
        settings.set("coupling.md_hold", GetParam());
        return settings;
    }
};

// The position in the protocol is that of the contact engine: q^{n+1} = q^n + dt U^{n+1}, whatever
// the kicks.
TEST_P(HeldOrNot, AGrainThatTouchesNothingMovesAsUnderTheContactEngine) {
    Single md(settings());
    NscdAdapter nscd;
    nscd.initialise(settings(), discs, {grain_at(7, 5.0, 10.0)});
    for (std::int64_t n = 0; n < 20; ++n) {
        const Motion sent = md.adapter.advance(window(n), {});
        const Motion wanted = nscd.advance(window(n), {});
        for (int axis = 0; axis < 2; ++axis)
            EXPECT_NEAR(sent.grains[0].position[axis], wanted.grains[0].position[axis], 1e-13);
        const GrainState moved = md.adapter.apply_kick(window(n), {some_kick(7, n)}).grains[0];
        const GrainState same = nscd.apply_kick(window(n), {some_kick(7, n)}).grains[0];
        for (int axis = 0; axis < 2; ++axis)
            EXPECT_NEAR(moved.position[axis], same.position[axis], 1e-13);
        for (int part = 0; part < 4; ++part)
            EXPECT_NEAR(moved.orientation[part], same.orientation[part], 1e-13);
        EXPECT_EQ(moved.velocity, same.velocity);
        EXPECT_EQ(moved.angular_velocity, same.angular_velocity);
    }
}

// A window that is repeated holds what brings the grain to the velocity that the fluid answered;
// the next one holds the impulse of its kick, or nothing.
TEST_P(HeldOrNot, ARepetitionLeavesNothingToTheNextWindow) {
    Settings repeated = settings();
    repeated.set("run.repeats_windows", true);
    Single md(repeated);
    const GrainState sent = md.adapter.advance(window(0), {}).grains[0];
    FreeResponse answer;
    answer.id = 7;
    answer.velocity = sent.velocity + Vec3{0.25, 0.0, 0.0};
    const GrainState again = md.adapter.advance(window(0), {answer}).grains[0];
    EXPECT_GT(again.announced_impulse[0], 0.05);
    const Kick kick = kick_of(7, again.velocity, 0.0, {0.5, 0.0, 0.0}, 0.0);
    md.adapter.apply_kick(window(0), {kick});
    const GrainState next = md.adapter.advance(window(1), {}).grains[0];
    EXPECT_EQ(next.announced_impulse[0], GetParam() ? 0.5 : 0.0);
}

// M dU = J_c + J_h - weight dt, with J_c summed by the host, on the floor and in flight.
TEST_P(HeldOrNot, MomentumBalances) {
    Settings with_radius = settings();
    with_radius.set("fluid.hydrodynamic_radius", 0.9);
    Single md(with_radius, 0.4995);
    const double mass = area * (1.5 - 0.81), weight = area * 0.5;
    Vec3 before{};
    bool pushed = false;
    for (std::int64_t n = 0; n < 20; ++n) {
        const GrainState sent = md.adapter.advance(window(n, true), {}).grains[0];
        for (int axis = 0; axis < 2; ++axis)
            EXPECT_NEAR(mass * (sent.velocity[axis] - before[axis]),
                        sent.contact_impulse[axis] + sent.announced_impulse[axis] -
                            (axis == 1 ? weight * dt : 0.0),
                        1e-15);
        pushed |= sent.contact_impulse[1] > 1e-3;
        before = md.adapter.apply_kick(window(n), {some_kick(7, n)}).grains[0].velocity;
    }
    EXPECT_TRUE(pushed);
}

// Without output the sum is not requested and follows from the momentum; the two agree.
TEST_P(HeldOrNot, ContactImpulsesAreTheSameInAnyWindow) {
    Single summed(settings(), 0.499), inferred(settings(), 0.499);
    for (std::int64_t n = 0; n < 10; ++n) {
        const GrainState a = summed.adapter.advance(window(n, true), {}).grains[0];
        const GrainState b = inferred.adapter.advance(window(n, false), {}).grains[0];
        EXPECT_EQ(a.velocity, b.velocity);
        for (int axis = 0; axis < 2; ++axis)
            EXPECT_NEAR(a.contact_impulse[axis], b.contact_impulse[axis], 1e-15);
        EXPECT_NEAR(a.contact_angular_impulse[2], b.contact_angular_impulse[2], 1e-15);
        summed.adapter.apply_kick(window(n), {some_kick(7, n)});
        inferred.adapter.apply_kick(window(n), {some_kick(7, n)});
    }
}

INSTANTIATE_TEST_SUITE_P(MdAdapter, HeldOrNot, testing::Bool(),
                         [](const auto& info) { return info.param ? "Held" : "NotHeld"; });

// c = 1/3: cM = area/2, cI = cM R^2/2 = cM/8.
TEST(MdAdapter, HoldsAndAnnouncesTheLastImpulse) {
    Single md(md_settings());
    const GrainState first = md.adapter.advance(window(0), {}).grains[0];
    EXPECT_EQ(first.announced_impulse, Vec3{});
    EXPECT_NEAR(first.velocity[1], -dt, 1e-15);
    md.adapter.apply_kick(window(0), {kick_of(7, {}, 0.0, {0.02, 0.003, 0.0}, 0.004)});
    const GrainState second = md.adapter.advance(window(1), {}).grains[0];
    EXPECT_EQ(second.announced_impulse, (Vec3{0.02, 0.003, 0.0}));
    EXPECT_EQ(second.announced_angular_impulse, (Vec3{0.0, 0.0, 0.004}));
    EXPECT_NEAR(second.velocity[0], 0.02 / (0.5 * area), 1e-14);
    EXPECT_NEAR(second.velocity[1], 0.003 / (0.5 * area) - dt, 1e-14);
    EXPECT_NEAR(second.angular_velocity[2], 0.004 / (0.5 * area * 0.125), 1e-13);
}

TEST(MdAdapter, HoldsNothingIfDisabled) {
    Settings settings = md_settings();
    settings.set("coupling.md_hold", false);
    Single md(settings);
    md.adapter.advance(window(0), {});
    md.adapter.apply_kick(window(0), {kick_of(7, {}, 0.0, {0.02, 0.003, 0.0}, 0.004)});
    const GrainState second = md.adapter.advance(window(1), {}).grains[0];
    EXPECT_EQ(second.announced_impulse, Vec3{});
    EXPECT_NEAR(second.velocity[0], 0.0, 1e-15);
}

// A kick must not push a grain into the floor without a spring force.
TEST(MdAdapter, AGrainThatTouchedStaysWhereItIs) {
    Single md(md_settings(), 0.4999);
    const double lead = 0.5 * (dt - dt / 8);
    const GrainState sent = md.adapter.advance(window(0), {}).grains[0];
    nscd::Bodies host;
    host.position.resize(1), host.orientation.resize(1), host.twist.resize(1);
    md.host.read(host);
    const double place = host.position[0][1];
    EXPECT_GT(sent.contact_impulse[1], 0.0);
    const GrainState moved =
        md.adapter.apply_kick(window(0), {kick_of(7, {0.0, -1.0, 0.0}, 0.0, {}, 0.0)}).grains[0];
    md.host.read(host);
    EXPECT_EQ(host.position[0][1], place);
    EXPECT_NEAR(moved.position[1], place - lead, 1e-15);
}

TEST(MdAdapter, IdentifiesItself) {
    Single md(md_settings());
    const Hello hello = md.adapter.describe();
    EXPECT_EQ(hello.adapter, "yade-md");
    EXPECT_EQ(hello.host_code, "leap-frog");
    EXPECT_TRUE(hello.capabilities.native_substeps);
    EXPECT_FALSE(hello.capabilities.effective_inertia);
    EXPECT_EQ(hello.capabilities.shapes, std::vector<std::string>{"disc"});
    const Motion motion = md.adapter.advance(window(0), {});
    EXPECT_EQ(motion.report.iterations, 8);
    EXPECT_FALSE(motion.report.residual.has_value());
}

TEST(MdAdapter, RemovesAndCountsGrainsPastAFreeSideWithWhatTheyHeld) {
    Settings settings = md_settings();
    settings.set("domain.right", std::string("free"));
    LeapFrogHost host;
    MdAdapter adapter("yade-md", host);
    adapter.initialise(settings, discs, {grain_at(1, 9.0, 5.0), grain_at(2, 5.0, 5.0)});
    adapter.advance(window(0), {});
    Motion motion =
        adapter.apply_kick(window(0), {kick_of(1, {200.0, 0.0, 0.0}, 0.0, {1.0, 0.0, 0.0}, 0.0),
                                       kick_of(2, {}, 0.0, {0.02, 0.0, 0.0}, 0.0)});
    EXPECT_EQ(motion.report.removed, 1);
    ASSERT_EQ(motion.grains.size(), 1u);
    EXPECT_EQ(motion.grains[0].id, 2);
    motion = adapter.advance(window(1), {});
    EXPECT_EQ(motion.report.removed, 0);
    EXPECT_EQ(motion.grains[0].announced_impulse, (Vec3{0.02, 0.0, 0.0}));
}

TEST(MdAdapter, RestartsBitForBit) {
    Single whole(md_settings(), 0.6), second(md_settings(), 0.6);
    const auto play = [](Single& md, std::int64_t first, std::int64_t last) {
        for (std::int64_t n = first; n < last; ++n) {
            md.adapter.advance(window(n), {});
            md.adapter.apply_kick(window(n), {some_kick(7, n)});
        }
    };
    play(whole, 0, 10);
    second.adapter.restore(whole.adapter.save());
    play(whole, 10, 20);
    play(second, 10, 20);
    EXPECT_EQ(whole.adapter.save(), second.adapter.save());
}

TEST(MdAdapter, RefusesWhatItDoesNotKnow) {
    LeapFrogHost host;
    Settings cyclic = md_settings();
    for (const char* side : {"domain.left", "domain.right"})
        cyclic.set(side, std::string("cyclic"));
    const std::string sides = refusal<std::invalid_argument>(
        [&] { MdAdapter("yade-md", host).initialise(cyclic, discs, {}); });
    EXPECT_TRUE(contains(sides, "domain.left = cyclic")) << sides;
    const std::string shape = refusal<std::invalid_argument>([&] {
        MdAdapter("yade-md", host).initialise(md_settings(), {{"triangle", {}}}, {});
    });
    EXPECT_TRUE(contains(shape, "\"triangle\"")) << shape;
    Single md(md_settings());
    const std::string joint = refusal<std::runtime_error>(
        [&] { md.adapter.advance(window(0), std::vector<FreeResponse>(1)); });
    EXPECT_TRUE(contains(joint, "split")) << joint;
    const std::string early =
        refusal<std::logic_error>([&] { md.adapter.apply_kick(window(0), {}); });
    EXPECT_TRUE(contains(early, "advance")) << early;
}

TEST(MdAdapter, EveryGrainNeedsExactlyOneKick) {
    Single md(md_settings());
    md.adapter.advance(window(3), {});
    const std::string text =
        refusal<std::runtime_error>([&] { md.adapter.apply_kick(window(3), {}); });
    EXPECT_TRUE(contains(text, "no kick") && contains(text, "grain 7")) << text;
}

}  // namespace
}  // namespace turbidite
