// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd_adapter/nscd_adapter.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <numbers>

#include "tests/unit/nscd_adapter/contact_case.hpp"

namespace turbidite {
namespace {

const ShapeTable discs = {{"disc", {}}};

Window window(std::int64_t index, double step = 0.01) {
    Window result;
    result.index = index;
    result.time = double(index) * step;
    result.step = step;
    return result;
}

/// A fluid that does not change velocities.
std::vector<Kick> same_velocities(const Motion& motion) {
    std::vector<Kick> kicks;
    for (const GrainState& grain : motion.grains) {
        Kick kick;
        kick.id = grain.id;
        kick.velocity = grain.velocity;
        kick.angular_velocity = grain.angular_velocity;
        kicks.push_back(kick);
    }
    return kicks;
}

/// The text of the error thrown by `call`.
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

// Effective mass and weight have the same factor c = 1 - rho_f/rho_s: one window from rest gives -g
// dt.
TEST(NscdAdapter, ImmersedGrainFallsWithGravity) {
    for (const double dt : {0.02, 0.01, 0.005}) {
        NscdAdapter adapter;
        adapter.initialise(box_settings(), discs, {grain_at(1, 5, 10)});
        const Motion motion = adapter.advance(window(0, dt), {});
        EXPECT_NEAR(motion.grains[0].velocity[1], -dt, 1e-15);
        EXPECT_EQ(motion.grains[0].position, (Vec3{5, 10, 0})) << "advance does not move";
    }
}

// R_h/R = 0.9: (M - m_f) g / (M - rho_f V(R_h)) = (1.5 - 1)/(1.5 - 0.81) g.
TEST(NscdAdapter, HydrodynamicRadiusChangesTheFall) {
    Settings settings = box_settings();
    settings.set("fluid.hydrodynamic_radius", 0.9);
    NscdAdapter adapter;
    adapter.initialise(settings, discs, {grain_at(1, 5, 10)});
    const Motion motion = adapter.advance(window(0), {});
    EXPECT_NEAR(motion.grains[0].velocity[1], -0.01 * 0.5 / 0.69, 1e-15);
}

/// Floor reaction of one grain at rest, over dt.
double reaction(bool fluid) {
    Settings settings = box_settings();
    settings.set("fluid.enabled", fluid);
    NscdAdapter adapter;
    adapter.initialise(settings, discs, {grain_at(1, 5, 0.5)});
    const Motion motion = adapter.advance(window(0), {});
    EXPECT_EQ(motion.report.contacts, 1);
    EXPECT_TRUE(motion.report.converged);
    return motion.grains[0].contact_impulse[1] / 0.01;
}

// The floor carries the buoyant weight (rho_s - rho_f) V g under water, rho_s V g when dry.
TEST(NscdAdapter, ReactionIsTheBuoyantWeight) {
    EXPECT_NEAR(reaction(true), 0.5 * std::numbers::pi / 4, 1e-13);
    EXPECT_NEAR(reaction(false), 1.5 * std::numbers::pi / 4, 1e-13);
}

// J_t sums of a spinning grain on the floor: W_tt = 3/m', spin -> slip speed R s = 0.05, friction
// needs 0.05 m'/3 with m' = 0.5 pi/4, below mu J_n = 0.3 m' g dt only if dt > 0.0556: at dt = 0.01
// it slides, so the angular impulse is -R mu J_n = -0.5 * 0.3 * m' * 0.01.
TEST(NscdAdapter, ReportsTheAngularImpulse) {
    GrainState spinning = grain_at(1, 5, 0.5);
    spinning.angular_velocity = {0.0, 0.0, 0.1};
    NscdAdapter adapter;
    adapter.initialise(box_settings(), discs, {spinning});
    const Motion motion = adapter.advance(window(0), {});
    EXPECT_NEAR(motion.grains[0].contact_angular_impulse[2],
                -0.5 * 0.3 * 0.5 * std::numbers::pi / 4 * 0.01, 1e-14);
}

/// One window of a falling grain whose kick has velocity (0.3, -0.2) and spin 2.
Motion kicked(const std::string& positions) {
    Settings settings = box_settings();
    settings.set("coupling.positions", positions);
    NscdAdapter adapter;
    adapter.initialise(settings, discs, {grain_at(4, 5, 10)});
    std::vector<Kick> kicks = same_velocities(adapter.advance(window(0), {}));
    kicks[0].velocity = {0.3, -0.2, 0.0};
    kicks[0].angular_velocity = {0.0, 0.0, 2.0};
    return adapter.apply_kick(window(0), kicks);
}

// `corrected`: q + dt U^{n+1}; `contact`: q + dt U^{n+4/5} = (0, -g dt) dt. The velocities are
// those of the kick.
TEST(NscdAdapter, MovesWithTheVelocitiesOfTheCase) {
    const GrainState corrected = kicked("corrected").grains[0];
    EXPECT_NEAR(corrected.position[0], 5.003, 1e-14);
    EXPECT_NEAR(corrected.position[1], 9.998, 1e-14);
    EXPECT_NEAR(corrected.orientation[3], std::sin(0.01), 1e-15);
    const GrainState contact = kicked("contact").grains[0];
    EXPECT_NEAR(contact.position[0], 5.0, 1e-14);
    EXPECT_NEAR(contact.position[1], 10.0 - 1e-4, 1e-14);
    EXPECT_EQ(contact.velocity, (Vec3{0.3, -0.2, 0.0}));
    EXPECT_EQ(contact.angular_velocity, (Vec3{0.0, 0.0, 2.0}));
}

TEST(NscdAdapter, DryGrainsMoveWithoutKicks) {
    Settings settings = box_settings();
    settings.set("fluid.enabled", false);
    NscdAdapter adapter;
    adapter.initialise(settings, discs, {grain_at(4, 5, 10)});
    adapter.advance(window(0), {});
    const Motion motion = adapter.apply_kick(window(0), {});
    EXPECT_NEAR(motion.grains[0].position[1], 10.0 - 1e-4, 1e-14);
    EXPECT_NEAR(motion.grains[0].velocity[1], -0.01, 1e-16);
}

TEST(NscdAdapter, EveryGrainNeedsExactlyOneKick) {
    const auto error = [](const std::function<void(std::vector<Kick>&)>& spoil) {
        NscdAdapter adapter;
        adapter.initialise(box_settings(), discs, {grain_at(11, 3, 10), grain_at(22, 7, 10)});
        std::vector<Kick> kicks = same_velocities(adapter.advance(window(3), {}));
        spoil(kicks);
        return refusal<std::runtime_error>([&] { adapter.apply_kick(window(3), kicks); });
    };
    const std::string missing = error([](auto& kicks) { kicks.pop_back(); });
    EXPECT_TRUE(contains(missing, "no kick") && contains(missing, "grain 22")) << missing;
    const std::string twice = error([](auto& kicks) { kicks[1].id = 11; });
    EXPECT_TRUE(contains(twice, "two kicks") && contains(twice, "grain 11")) << twice;
    const std::string stranger = error([](auto& kicks) { kicks[0].id = 99; });
    EXPECT_TRUE(contains(stranger, "grain 99")) << stranger;
    const std::string none = error([](auto& kicks) { kicks.clear(); });
    EXPECT_TRUE(contains(none, "no kick") && contains(none, "grain 11")) << none;
}

TEST(NscdAdapter, KicksMayComeInAnyOrder) {
    NscdAdapter adapter;
    adapter.initialise(box_settings(), discs, {grain_at(11, 3, 10), grain_at(22, 7, 10)});
    std::vector<Kick> kicks = same_velocities(adapter.advance(window(0), {}));
    kicks[0].velocity = {1.0, 0.0, 0.0};
    std::swap(kicks[0], kicks[1]);
    const Motion motion = adapter.apply_kick(window(0), kicks);
    EXPECT_EQ(motion.grains[0].id, 11);
    EXPECT_EQ(motion.grains[0].velocity, (Vec3{1.0, 0.0, 0.0}));
}

// A kick with speed 100 downwards over dt = 0.01 from y = 0.5: the centre reaches -0.5.
TEST(NscdAdapter, RefusesAGrainThroughAWall) {
    NscdAdapter adapter;
    adapter.initialise(box_settings(), discs, {grain_at(17, 5, 0.5)});
    std::vector<Kick> kicks = same_velocities(adapter.advance(window(12), {}));
    kicks[0].velocity = {0.0, -100.0, 0.0};
    const std::string text =
        refusal<PhysicsRefused>([&] { adapter.apply_kick(window(12), kicks); });
    for (const char* part : {"grain 17", "(5, -0.5)", "bottom wall", "window 12"})
        EXPECT_TRUE(contains(text, part)) << text;
}

TEST(NscdAdapter, RefusesWhatIsNotANumber) {
    NscdAdapter adapter;
    adapter.initialise(box_settings(), discs, {grain_at(17, 5, 5)});
    std::vector<Kick> kicks = same_velocities(adapter.advance(window(4), {}));
    kicks[0].velocity[0] = std::numeric_limits<double>::quiet_NaN();
    const std::string text = refusal<PhysicsRefused>([&] { adapter.apply_kick(window(4), kicks); });
    for (const char* part : {"grain 17", "not finite", "window 4"})
        EXPECT_TRUE(contains(text, part)) << text;
}

// The right side is open at x = 10: a disc of radius 0.5 stays until its centre is past 10.5.
TEST(NscdAdapter, RemovesAndCountsGrainsPastAFreeSide) {
    Settings settings = box_settings();
    settings.set("domain.right", std::string("free"));
    NscdAdapter adapter;
    adapter.initialise(settings, discs, {grain_at(1, 9.0, 5), grain_at(2, 5, 5)});
    std::vector<Kick> kicks = same_velocities(adapter.advance(window(0), {}));
    kicks[0].velocity = {149.0, 0.0, 0.0};
    Motion motion = adapter.apply_kick(window(0), kicks);
    EXPECT_EQ(motion.report.removed, 0);
    EXPECT_EQ(motion.grains.size(), 2u);
    kicks = same_velocities(adapter.advance(window(1), {}));
    kicks[0].velocity = {2.0, 0.0, 0.0};
    motion = adapter.apply_kick(window(1), kicks);
    EXPECT_EQ(motion.report.removed, 1);
    ASSERT_EQ(motion.grains.size(), 1u);
    EXPECT_EQ(motion.grains[0].id, 2);
    EXPECT_EQ(adapter.advance(window(2), {}).report.removed, 0);
}

// Two discs on top of each other, the upper one thrown out through the right side: contacts are
// reported when output is due, as they were solved, and without those of the grain that left.
TEST(NscdAdapter, TellsContactsInWindowsWithOutput) {
    Settings settings = box_settings();
    settings.set("domain.right", std::string("free"));
    NscdAdapter adapter;
    adapter.initialise(settings, discs, {grain_at(7, 5, 1.5), grain_at(3, 5, 0.5)});
    Window now = window(0);
    Motion motion = adapter.advance(now, {});
    EXPECT_FALSE(adapter.apply_kick(now, same_velocities(motion)).contacts);
    now = window(1);
    now.write_output = true;
    motion = adapter.advance(now, {});
    EXPECT_FALSE(motion.contacts) << "the fluid has no use for them";
    motion = adapter.apply_kick(now, same_velocities(motion));
    ASSERT_EQ(motion.contacts->size(), 2u);
    EXPECT_EQ(motion.contacts->at(0).a, 3);
    EXPECT_EQ(motion.contacts->at(0).b, 7);
    EXPECT_EQ(motion.contacts->at(1).wall, 2) << "0 left, 1 right, 2 bottom, 3 top";
    ASSERT_TRUE(motion.report.quad && motion.report.max && motion.report.residual);
    EXPECT_LE(*motion.report.quad, *motion.report.max);
    EXPECT_LT(*motion.report.max, 1e-6) << "solved to 1e-10";

    now.index = 2;
    std::vector<Kick> kicks = same_velocities(adapter.advance(now, {}));
    kicks[0].velocity = {1000.0, 0.0, 0.0};
    motion = adapter.apply_kick(now, kicks);
    EXPECT_EQ(motion.report.removed, 1);
    ASSERT_EQ(motion.contacts->size(), 1u);
    EXPECT_EQ(motion.contacts->at(0).wall, 2);
}

// Period 10: from 9.99 at speed 2 over 0.01 to 0.01.
TEST(NscdAdapter, WrapsCyclicSides) {
    Settings settings = box_settings();
    settings.set("domain.left", std::string("cyclic"));
    settings.set("domain.right", std::string("cyclic"));
    NscdAdapter adapter;
    adapter.initialise(settings, discs, {grain_at(1, 9.99, 5)});
    std::vector<Kick> kicks = same_velocities(adapter.advance(window(0), {}));
    kicks[0].velocity = {2.0, 0.0, 0.0};
    EXPECT_NEAR(adapter.apply_kick(window(0), kicks).grains[0].position[0], 0.01, 1e-13);
}

// A single cyclic side is meaningless; with a period of 1.5 two discs would touch on both sides.
TEST(NscdAdapter, RefusesImpossibleCyclicSides) {
    Settings settings = box_settings();
    settings.set("domain.right", std::string("cyclic"));
    const std::string half =
        refusal<Failure>([&] { NscdAdapter().initialise(settings, discs, {}); });
    EXPECT_TRUE(contains(half, "domain.left and domain.right")) << half;
    settings.set("domain.left", std::string("cyclic"));
    settings.set("run.size_x", 1.5);
    const std::string narrow = refusal<std::invalid_argument>([&] {
        NscdAdapter().initialise(settings, discs, {grain_at(1, 0.5, 5), grain_at(2, 0.5, 7)});
    });
    EXPECT_TRUE(contains(narrow, "more than 2")) << narrow;
}

// Discs at distance 0.95 overlap by 0.05; the wall at 0 is overlapped by 0.02.
TEST(NscdAdapter, ReportsTheDeepestOverlapOfWhatItReturns) {
    NscdAdapter adapter;
    const Motion start =
        adapter.initialise(box_settings(), discs, {grain_at(1, 0.48, 5), grain_at(2, 1.43, 5)});
    EXPECT_NEAR(start.report.max_penetration, 0.05, 1e-14);
    std::vector<Kick> kicks = same_velocities(adapter.advance(window(0), {}));
    kicks[0].velocity = {0.0, 0.0, 0.0};
    kicks[1].velocity = {-1.0, 0.0, 0.0};
    EXPECT_NEAR(adapter.apply_kick(window(0), kicks).report.max_penetration, 0.06, 1e-14);
}

/// A column of grains that fall on each other.
std::vector<GrainState> column() {
    std::vector<GrainState> grains;
    for (int k = 0; k < 15; ++k) grains.push_back(grain_at(k, 5 + 0.1 * (k % 3), 0.5 + 1.05 * k));
    return grains;
}

Motion windows(NscdAdapter& adapter, std::int64_t first, std::int64_t last) {
    Motion motion;
    for (std::int64_t n = first; n < last; ++n)
        motion = adapter.apply_kick(window(n), same_velocities(adapter.advance(window(n), {})));
    return motion;
}

TEST(NscdAdapter, RestartsBitForBit) {
    NscdAdapter whole, second;
    whole.initialise(box_settings(), discs, column());
    windows(whole, 0, 100);
    second.initialise(box_settings(), discs, column());
    second.restore(whole.save());
    windows(whole, 100, 200);
    windows(second, 100, 200);
    EXPECT_EQ(whole.save(), second.save());
}

// A host that stores bodies in its own files copies them, and passes the contact impulses on.
TEST(NscdAdapter, HostMayKeepBodiesItself) {
    NscdAdapter whole, second;
    whole.initialise(box_settings(), discs, column());
    windows(whole, 0, 100);
    second.initialise(box_settings(), discs, column());
    second.bodies().position = whole.bodies().position;
    second.bodies().orientation = whole.bodies().orientation;
    second.bodies().twist = whole.bodies().twist;
    second.take_over_contacts(whole.contact_memory());
    windows(whole, 100, 200);
    windows(second, 100, 200);
    EXPECT_EQ(whole.save(), second.save());
}

TEST(NscdAdapter, IdentifiesItself) {
    const Hello hello = NscdAdapter("yade-nscd", "YADE 2023.02a").describe();
    EXPECT_EQ(hello.adapter, "yade-nscd");
    EXPECT_EQ(hello.host_code, "YADE 2023.02a");
    EXPECT_FALSE(hello.adapter_version.empty());
    EXPECT_EQ(hello.role, Role::grains);
    EXPECT_EQ(hello.capabilities.shapes,
              (std::vector<std::string>{"disc", "polygon", "triangle", "sphere"}));
    const std::vector<std::string>& laws = hello.capabilities.contact_laws;
    for (const char* law : {"coulomb", "static-dynamic", "moreau", "capillary"})
        EXPECT_NE(std::find(laws.begin(), laws.end(), law), laws.end()) << law;
    EXPECT_TRUE(hello.capabilities.effective_inertia);
}

/// A grain that falls at `speed`, with mass 2 along x, 3 along y and moment of inertia 1, and a
/// coupling of 0.5 between y and spin.
FreeResponse falling_at(GrainId id, double speed) {
    FreeResponse response;
    response.id = id;
    response.velocity = {0.0, -speed, 0.0};
    response.inertia[upper_entry(0, 0)] = 2.0;
    response.inertia[upper_entry(1, 1)] = 3.0;
    response.inertia[upper_entry(1, 5)] = 0.5;
    response.inertia[upper_entry(5, 5)] = 1.0;
    return response;
}

// Frictionless floor: U_y = 0 after an impulse J, so J/det * I = speed with the inverse of ((3,
// 0.5), (0.5, 1)): det = 2.75, U_y = J/2.75, spin = -0.5 J/2.75. The grain touches the floor and
// falls at 0.11: J = 0.3025.
TEST(NscdAdapter, JointSolvesContactsWithTheFluidsInertia) {
    Settings settings = box_settings();
    settings.set("contact.friction", 0.0);
    NscdAdapter adapter;
    adapter.initialise(settings, discs, {grain_at(7, 5, 0.5)});
    const GrainState grain = adapter.advance(window(0), {falling_at(7, 0.11)}).grains[0];
    EXPECT_NEAR(grain.contact_impulse[1], 0.3025, 1e-12);
    EXPECT_NEAR(grain.velocity[1], 0.0, 1e-12);
    EXPECT_NEAR(grain.angular_velocity[2], -0.055, 1e-12);
}

// The kick sets the velocity; the contact solve determines the displacement: U = (0, 0) in it,
// whatever coupling.positions is.
TEST(NscdAdapter, JointMovesWithTheContactVelocity) {
    Settings settings = box_settings();
    settings.set("contact.friction", 0.0);
    NscdAdapter adapter;
    adapter.initialise(settings, discs, {grain_at(7, 5, 0.5)});
    std::vector<Kick> kicks = same_velocities(adapter.advance(window(0), {falling_at(7, 0.11)}));
    kicks[0].velocity = {1e-6, -1e-6, 0.0};
    const GrainState grain = adapter.apply_kick(window(0), kicks).grains[0];
    EXPECT_EQ(grain.velocity, (Vec3{1e-6, -1e-6, 0.0}));
    EXPECT_NEAR(grain.position[1], 0.5, 1e-13);
    EXPECT_NEAR(grain.position[0], 5.0, 1e-13);
}

// Rounds: the second solve starts from the first one's impulses and depends on nothing else of it.
TEST(NscdAdapter, JointMayRepeatAdvanceWithinAWindow) {
    std::vector<GrainState> grains;
    std::vector<FreeResponse> first, second;
    for (int k = 0; k < 15; ++k) {
        grains.push_back(grain_at(k, 5, 0.5 + k));
        first.push_back(falling_at(k, 0.1));
        second.push_back(falling_at(k, 0.1001));
    }
    NscdAdapter rounds, direct;
    rounds.initialise(box_settings(), discs, grains);
    direct.initialise(box_settings(), discs, grains);
    const Motion cold = rounds.advance(window(0), first);
    const Motion same = rounds.advance(window(0), first);
    EXPECT_GT(cold.report.iterations, 20);
    EXPECT_LE(same.report.iterations, 2);
    const Motion warm = rounds.advance(window(0), second);
    const Motion reference = direct.advance(window(0), second);
    EXPECT_LT(warm.report.iterations, reference.report.iterations);
    for (int k = 0; k < 15; ++k) {
        EXPECT_NEAR(warm.grains[k].velocity[1], reference.grains[k].velocity[1], 1e-8);
        EXPECT_NEAR(warm.grains[k].contact_impulse[1], reference.grains[k].contact_impulse[1],
                    1e-6);
        EXPECT_EQ(warm.grains[k].position, grains[k].position);
    }
}

TEST(NscdAdapter, JointNeedsExactlyOneResponsePerGrain) {
    const auto error = [](std::vector<FreeResponse> responses) {
        NscdAdapter adapter;
        adapter.initialise(box_settings(), discs, {grain_at(11, 3, 10), grain_at(22, 7, 10)});
        return refusal<std::runtime_error>([&] { adapter.advance(window(3), responses); });
    };
    EXPECT_EQ(error({falling_at(11, 0)}), "no response was received for grain 22 in window 3");
    EXPECT_EQ(error({falling_at(11, 0), falling_at(11, 0)}),
              "two responses were received for grain 11 in window 3");
    EXPECT_EQ(error({falling_at(99, 0), falling_at(11, 0)}),
              "a response was received for grain 99, which this rank does not have, in window 3");
}

// A response without inertia: the grain keeps its motion, and others come to rest on it.
TEST(NscdAdapter, JointKeepsThePrescribedMotionThatTheFluidAnswersWith) {
    NscdAdapter adapter;
    GrainState driven = grain_at(11, 3, 10);
    driven.prescribed = true;
    driven.velocity = {0.0, 0.25, 0.0};
    adapter.initialise(box_settings(), discs, {driven, grain_at(22, 3, 11)});
    FreeResponse held;
    held.id = 11;
    held.velocity = driven.velocity;
    FreeResponse falling = falling_at(22, 0.0);
    falling.velocity[1] = -0.5;
    const Motion motion = adapter.advance(window(0), {held, falling});
    EXPECT_EQ(motion.grains[0].velocity, driven.velocity);
    EXPECT_NEAR(motion.grains[1].velocity[1], 0.25, 1e-9);
    EXPECT_GT(motion.grains[1].contact_impulse[1], 0.1);
}

TEST(NscdAdapter, JointRefusesGrainsThatAreFixedOnOneSideOnly) {
    const auto error = [](bool fixed, const FreeResponse& response) {
        NscdAdapter adapter;
        adapter.initialise(box_settings(), discs, {grain_at(11, 3, 10)});
        adapter.bodies().fixed[0] = fixed;
        return refusal<std::runtime_error>([&] { adapter.advance(window(3), {response}); });
    };
    FreeResponse held;
    held.id = 11;
    EXPECT_TRUE(contains(error(true, falling_at(11, 0.0)), "grain 11 is fixed by its host"));
    EXPECT_TRUE(contains(error(false, held), "grain 11 is released by its host in window 3"));
}

TEST(NscdAdapter, JointAcceptsAFixedGrainThatItsHostAlsoKeepsFromRotating) {
    NscdAdapter adapter;
    GrainState fixed = grain_at(11, 3, 10);
    fixed.prescribed = true;
    adapter.initialise(box_settings(), discs, {fixed});
    adapter.bodies().rotation_blocked[0] = 1;
    FreeResponse held;
    held.id = 11;
    const Motion motion = adapter.advance(window(0), {held});
    EXPECT_EQ(motion.grains[0].velocity, fixed.velocity);
    EXPECT_EQ(motion.grains[0].position, fixed.position);
}

TEST(NscdAdapter, JointRefusesAnImpossibleInertia) {
    NscdAdapter adapter;
    adapter.initialise(box_settings(), discs, {grain_at(11, 3, 10)});
    FreeResponse response = falling_at(11, 0.0);
    response.inertia[upper_entry(1, 5)] = 2.0;  // 2^2 > 3 * 1
    const std::string text =
        refusal<PhysicsRefused>([&] { adapter.advance(window(3), {response}); });
    EXPECT_TRUE(contains(text, "inertia of grain 11 is not positive definite in window 3")) << text;
    adapter.bodies().rotation_blocked[0] = 1;
    const std::string held =
        refusal<std::runtime_error>([&] { adapter.advance(window(3), {falling_at(11, 0.0)}); });
    EXPECT_TRUE(contains(held, "grain 11 is kept from rotating by its host in window 3")) << held;
}

// Without responses and kicks the contact velocities are final.
TEST(NscdAdapter, WithoutFluidItFallsFreely) {
    Settings settings = box_settings();
    settings.set("fluid.enabled", false);
    NscdAdapter adapter;
    adapter.initialise(settings, discs, {grain_at(4, 5, 10)});
    adapter.advance(window(0), {});
    EXPECT_NEAR(adapter.apply_kick(window(0), {}).grains[0].velocity[1], -0.01, 1e-16);
}

/// Wet grains: c = 0.6 weights in air, which is 1.8 of the buoyant ones (rho_s = 1.5).
Settings wet_settings() {
    Settings settings = box_settings();
    settings.set("run.diameter", 1.0);
    settings.set("run.grain_weight", 1.5 * std::numbers::pi / 4);
    settings.set("contact.adhesion", std::string("wet"));
    settings.set("contact.adhesion_force", 0.6);
    settings.set("contact.adhesion_range", 0.05);
    return settings;
}

// Thresholds are physical forces in the system of the contact problem, (cM, cMg). A grain of
// buoyant weight 1/3 m g hangs below a fixed one: an attraction of 0.6 m g holds it, one of 0.33
// does not; the impulse reported for it balances its weight.
TEST(NscdAdapter, AdhesionHoldsBuoyantWeights) {
    for (const double strength : {0.34, 0.33}) {
        Settings settings = wet_settings();
        settings.set("contact.adhesion_force", strength);
        NscdAdapter adapter;
        adapter.initialise(settings, discs, {grain_at(1, 5, 10), grain_at(2, 5, 9)});
        adapter.bodies().fixed[0] = 1;
        const GrainState low = adapter.advance(window(0), {}).grains[1];
        const double mass = 0.5 * std::numbers::pi / 4;
        EXPECT_EQ(low.velocity[1] < -1e-9, strength < 1.0 / 3.0);
        EXPECT_NEAR(low.contact_impulse[1], mass * (low.velocity[1] + 0.01), 1e-14);
        EXPECT_GT(low.contact_impulse[1], 0.9 * 0.01 * mass);
    }
}

// Rounds of a window repeat the solve: the states found in a round apply only from the next window
// on.
TEST(NscdAdapter, JointBalancesWhatGrainsFeelUnderAdhesion) {
    Settings settings = wet_settings();
    NscdAdapter adapter;
    adapter.initialise(settings, discs, {grain_at(1, 5, 0.51), grain_at(2, 5.3, 1.50)});
    const std::vector<FreeResponse> responses = {falling_at(1, 0.001), falling_at(2, 0.002)};
    for (int round = 0; round < 2; ++round) {
        const Motion motion = adapter.advance(window(0), responses);
        for (int k = 0; k < 2; ++k) {
            const GrainState& grain = motion.grains[k];
            const double fall = grain.velocity[1] - responses[k].velocity[1];
            EXPECT_NEAR(grain.contact_impulse[0], 2.0 * grain.velocity[0], 1e-13);
            EXPECT_NEAR(grain.contact_impulse[1], 3.0 * fall + 0.5 * grain.angular_velocity[2],
                        1e-13);
            EXPECT_NEAR(grain.contact_angular_impulse[2], 0.5 * fall + grain.angular_velocity[2],
                        1e-13);
        }
        EXPECT_GT(std::abs(motion.grains[1].contact_impulse[1]), 1e-4) << "something must pull";
    }
}

TEST(NscdAdapter, RefusesTheSameIdTwice) {
    NscdAdapter adapter;
    const std::string text = refusal<std::runtime_error>([&] {
        adapter.initialise(box_settings(), discs, {grain_at(5, 3, 3), grain_at(5, 6, 6)});
    });
    EXPECT_TRUE(contains(text, "grain 5")) << text;
}

/// The files of contact problems written in a run of `windows`, and the text of the last one.
std::vector<std::string> dumps(const Settings& settings, std::int64_t windows, std::string& text) {
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / ("dumps-" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder);
    NscdAdapter adapter;
    adapter.set_run_folder(folder);
    Motion motion =
        adapter.initialise(settings, discs, {grain_at(1, 5.0, 0.5), grain_at(2, 5.0, 1.5)});
    for (std::int64_t n = 0; n < windows; ++n) {
        motion = adapter.advance(window(n), {});
        motion = adapter.apply_kick(window(n), same_velocities(motion));
    }
    std::vector<std::string> names;
    if (std::filesystem::exists(folder / "contacts"))
        for (const auto& entry : std::filesystem::directory_iterator(folder / "contacts"))
            names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    if (!names.empty()) {
        std::ifstream file(folder / "contacts" / names.back());
        text.assign(std::istreambuf_iterator<char>(file), {});
    }
    std::filesystem::remove_all(folder);
    return names;
}

// Every second window, named by the step of history.csv. Two plane contacts: with the floor, and
// between the discs.
TEST(NscdAdapter, WritesContactProblemsWhenAsked) {
    std::string text;
    EXPECT_TRUE(dumps(box_settings(), 4, text).empty());
    Settings settings = box_settings();
    settings.set("time.step", 0.01);
    settings.set("contact.dump_interval", 0.02);
    EXPECT_EQ(dumps(settings, 5, text),
              (std::vector<std::string>{"problem_2.dat", "problem_4.dat"}));
    EXPECT_EQ(text.substr(0, 8), "2\n2\n1\n4\n");
}

TEST(NscdAdapter, SolvesWithTheSolverOfTheCase) {
    Settings settings = box_settings();
    settings.set("contact.solver", std::string("central-path"));
    NscdAdapter adapter;
    adapter.initialise(settings, discs, {grain_at(1, 5.0, 0.5)});
    EXPECT_EQ(adapter.engine().settings().solver, "central-path");
    settings.set("contact.solver", std::string("newton"));
    EXPECT_NE(refusal<std::invalid_argument>([&] {
                  NscdAdapter().initialise(settings, discs, {grain_at(1, 5.0, 0.5)});
              }).find("known: nlgs"),
              std::string::npos);
}

}  // namespace
}  // namespace turbidite
