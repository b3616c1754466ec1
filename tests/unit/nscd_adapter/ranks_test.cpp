// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contact engine's adapters of several ranks under `joint`, each with its own grains, against
// one adapter with all of them: bit for bit, whatever the number of ranks; in the plane from two
// on.
#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <numbers>

#include "coupler/protocol/failure.hpp"
#include "granular_adapter/nscd_adapter/nscd_adapter.hpp"
#include "tests/unit/nscd/memory_exchange.hpp"
#include "tests/unit/nscd_adapter/contact_case.hpp"

namespace turbidite {
namespace {

using nscd::MemoryExchange;

const ShapeTable spheres = {{"sphere", {}}}, discs = {{"disc", {}}};

/// A box of 20 x 20 x 6 with a free right side, g = 1.
Settings box_in_space() {
    Settings s = box_settings();
    s.set("dimension", std::int64_t{3});
    s.set("fluid.enabled", false);
    s.set("run.dimension", std::int64_t{3});
    s.set("run.size_x", 20.0);
    s.set("run.size_z", 6.0);
    s.set("run.acceleration_z", 0.0);
    s.set("contact.tolerance", 1e-5);
    s.set("contact.restitution", 0.5);  // impacts ask for the velocity at the beginning of a window
    for (const char* side : {"front", "back"})
        s.set(std::string("domain.") + side, std::string("wall"));
    s.set("domain.right", std::string("free"));
    return s;
}

/// The same in the plane, of 56 x 20.
Settings box_in_the_plane() {
    Settings s = box_settings();
    s.set("fluid.enabled", false);
    s.set("run.size_x", 56.0);
    s.set("contact.tolerance", 1e-5);
    s.set("contact.restitution", 0.5);
    s.set("domain.right", std::string("free"));
    return s;
}

/// A heap of discs that slides to the right.
std::vector<GrainState> heap_in_the_plane() {
    std::vector<GrainState> grains;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 50; ++x) {
            GrainState grain = grain_at(static_cast<GrainId>(grains.size()), 0, 0);
            grain.position = {0.6 + 1.08 * x + 0.03 * y, 0.55 + 1.02 * y, 0.0};
            grain.velocity = {9.0, -0.5, 0.0};
            grains.push_back(grain);
        }
    return grains;
}

/// A heap that slides to the right.
std::vector<GrainState> heap() {
    std::vector<GrainState> grains;
    for (int y = 0; y < 3; ++y)
        for (int z = 0; z < 5; ++z)
            for (int x = 0; x < 14; ++x) {
                GrainState grain = grain_at(static_cast<GrainId>(grains.size()), 0, 0);
                grain.position = {0.6 + 1.08 * x + 0.03 * y, 0.55 + 1.02 * y,
                                  0.6 + 1.05 * z + 0.05 * y};
                grain.velocity = {9.0, -0.5, 0.4};
                grains.push_back(grain);
            }
    return grains;
}

/// A fluid with a linear drag, whose answers change a little with every round.
FreeResponse answer(const GrainState& grain, const GrainState& start, int round, double dt) {
    const double mass = 1.5 * std::numbers::pi / 6.0 + 0.02, inertia = 0.1 * mass;
    FreeResponse response;
    response.id = grain.id;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        response.velocity[axis] = 0.99 * start.velocity[axis] - (axis == 1 ? dt : 0.0);
        response.angular_velocity[axis] = 0.98 * start.angular_velocity[axis];
        if (round > 0) response.velocity[axis] += 1e-3 * grain.velocity[axis];
    }
    for (std::size_t i = 0; i < 6; ++i)
        response.inertia[upper_entry(i, i)] = i < 3 ? mass : inertia;
    return response;
}

/// In the plane; some grains, which not every rank has, move more easily along x than along y.
FreeResponse answer_in_the_plane(const GrainState& grain, const GrainState& start, int round,
                                 double dt) {
    FreeResponse response = answer(grain, start, round, dt);
    if (grain.id < 20) response.inertia[upper_entry(1, 1)] *= 1.3;
    return response;
}

/// The grains of all ranks in the order of their ids, and what else is compared.
struct State {
    std::map<GrainId, GrainState> grains;
    std::map<std::array<std::int64_t, 4>, ContactRecord> contacts;
    std::vector<double> numbers;
};

bool same(const GrainState& a, const GrainState& b) {
    return a.position == b.position && a.orientation == b.orientation && a.velocity == b.velocity &&
           a.angular_velocity == b.angular_velocity && a.contact_impulse == b.contact_impulse &&
           a.contact_angular_impulse == b.contact_angular_impulse;
}

/// What the coupler does between the ranks: everybody learns the grains of all.
class Messenger {
 public:
    explicit Messenger(MemoryExchange& ranks) : ranks_(ranks) {}

    std::map<GrainId, GrainState> all(const Motion& mine) const {
        std::map<GrainId, GrainState> grains;
        for (const GrainState& grain : nscd::gathered(ranks_, mine.grains))
            EXPECT_TRUE(grains.emplace(grain.id, grain).second) << grain.id;
        return grains;
    }

 private:
    MemoryExchange& ranks_;
};

constexpr double dt = 0.01;
constexpr int windows = 120, middle = 50;

Window window(int index) {
    Window window;
    window.index = index;
    window.time = index * dt;
    window.step = dt;
    window.write_output = index + 1 == windows;
    return window;
}

struct PlayedCase {
    Settings settings = box_in_space();
    ShapeTable shapes = spheres;
    std::vector<GrainState> grains = heap();
    FreeResponse (*answer)(const GrainState&, const GrainState&, int, double) = turbidite::answer;
};

PlayedCase in_the_plane() {
    return {box_in_the_plane(), discs, heap_in_the_plane(), answer_in_the_plane};
}

struct Played {
    State end;
    std::vector<SavedState> saved;  ///< by rank, after the window `middle`
    std::int64_t removed = 0;
    int moved = 0;  ///< changes of rank within a window
};

/// From the beginning, or from what was saved in the middle.
Played play(int ranks, const std::vector<SavedState>& from = {}, const PlayedCase& it = {}) {
    Played played;
    played.saved.resize(static_cast<std::size_t>(ranks));
    std::mutex mutex;
    nscd::on_ranks(ranks, [&](MemoryExchange& exchange) {
        const auto own = static_cast<std::size_t>(exchange.rank());
        NscdAdapter adapter;
        if (ranks > 1) adapter.share_with(exchange);
        std::vector<GrainState> mine;
        for (const GrainState& grain : it.grains)
            if (static_cast<int>(grain.id) % ranks == exchange.rank()) mine.push_back(grain);
        Motion state = adapter.initialise(it.settings, it.shapes, mine);
        if (!from.empty()) {
            from.size() == static_cast<std::size_t>(ranks) ? adapter.restore(from[own])
                                                           : adapter.restore_from(from);
            state.grains.clear();
        }
        const Messenger messenger(exchange);
        std::int64_t removed = 0;
        int moved = 0;
        if (!from.empty()) {  // what the coupler knows of the last state
            const nscd::Bodies& bodies = adapter.bodies();
            for (std::size_t i = 0; i < bodies.size(); ++i) {
                GrainState grain;
                grain.id = bodies.id[i];
                grain.velocity = bodies.twist[i].velocity;
                grain.angular_velocity = bodies.twist[i].spin;
                state.grains.push_back(grain);
            }
        }
        for (int n = from.empty() ? 0 : middle; n < windows; ++n) {
            const auto start = messenger.all(state);
            for (int round = 0; round < 2; ++round) {
                std::vector<FreeResponse> responses;
                for (const GrainState& grain : state.grains)
                    responses.push_back(it.answer(grain, start.at(grain.id), round, dt));
                const std::size_t before = state.grains.size();
                state = adapter.advance(window(n), responses);
                moved += before != state.grains.size();
            }
            std::vector<Kick> kicks;
            for (const GrainState& grain : state.grains) {
                Kick kick;
                kick.id = grain.id;
                kick.velocity = grain.velocity;
                kick.angular_velocity = grain.angular_velocity;
                kicks.push_back(kick);
            }
            state = adapter.apply_kick(window(n), kicks);
            removed += state.report.removed;
            if (n + 1 == middle) played.saved[own] = adapter.save();
            const std::lock_guard lock(mutex);
            for (const double x : {*state.report.residual, double(state.report.iterations)})
                if (exchange.rank() == 0) played.end.numbers.push_back(x);
        }
        const std::lock_guard lock(mutex);
        played.removed += removed;
        played.moved += moved;
        for (const GrainState& grain : state.grains)
            EXPECT_TRUE(played.end.grains.emplace(grain.id, grain).second);
        for (const ContactRecord& contact : *state.contacts)
            EXPECT_TRUE(played.end.contacts
                            .emplace(std::array{std::int64_t{contact.wall}, contact.a, contact.b,
                                                std::int64_t{contact.feature}},
                                     contact)
                            .second);
    });
    return played;
}

void expect_equal(const State& one, const State& many, bool with_numbers = true) {
    if (with_numbers) {
        EXPECT_EQ(one.numbers, many.numbers);
    }
    ASSERT_EQ(one.grains.size(), many.grains.size());
    for (const auto& [id, grain] : one.grains) EXPECT_TRUE(same(grain, many.grains.at(id))) << id;
    ASSERT_EQ(one.contacts.size(), many.contacts.size());
    for (const auto& [key, contact] : one.contacts) {
        EXPECT_EQ(contact.impulse, many.contacts.at(key).impulse);
        EXPECT_EQ(contact.point, many.contacts.at(key).point);
        EXPECT_EQ(contact.branch, many.contacts.at(key).branch);
    }
}

TEST(NscdAdapterOnRanks, HasTheBitsOfOneUnderJoint) {
    const Played one = play(1);
    ASSERT_GT(one.removed, 5) << "grains have to leave";
    ASSERT_GT(one.end.grains.size(), 50u);
    ASSERT_GT(one.end.contacts.size(), 50u);
    for (const int ranks : {2, 3}) {
        const Played many = play(ranks);
        expect_equal(one.end, many.end);
        EXPECT_EQ(one.removed, many.removed);
        EXPECT_GT(many.moved, 3) << "grains have to change their rank";
    }
}

TEST(NscdAdapterOnRanks, HasTheSameBitsInThePlaneUnderJoint) {
    const Played two = play(2, {}, in_the_plane());
    ASSERT_GT(two.removed, 5) << "grains have to leave";
    ASSERT_GT(two.end.contacts.size(), 50u);
    EXPECT_GT(two.moved, 3) << "grains have to change their rank";
    for (const int ranks : {3, 4}) {
        const Played many = play(ranks, {}, in_the_plane());
        expect_equal(two.end, many.end);
        EXPECT_EQ(two.removed, many.removed);
    }
    expect_equal(two.end, play(3, two.saved, in_the_plane()).end, false);
}

TEST(NscdAdapterOnRanks, GoesOnOnAnotherNumberOfRanks) {
    const Played whole = play(1);
    const std::vector<SavedState> of_two = play(2).saved;
    for (const int ranks : {1, 2, 3}) expect_equal(whole.end, play(ranks, of_two).end, false);
    expect_equal(whole.end, play(2, whole.saved).end, false);
}

// One rank finds a fault, the others neither wait for it nor stop with another one.
TEST(NscdAdapterOnRanks, AFaultOfOneIsThatOfOne) {
    nscd::on_ranks(2, [](MemoryExchange& exchange) {
        NscdAdapter adapter;
        adapter.share_with(exchange);
        std::vector<GrainState> mine = {
            grain_at(exchange.rank(), 3.0 + 8.0 * exchange.rank(), 5.0)};
        mine[0].position[2] = 3.0;
        const Motion state = adapter.initialise(box_in_space(), spheres, mine);
        std::vector<FreeResponse> responses;
        for (const GrainState& grain : state.grains)
            if (grain.id != 1) responses.push_back(answer(grain, grain, 0, dt));
        const bool has_it = std::any_of(state.grains.begin(), state.grains.end(),
                                        [](const GrainState& grain) { return grain.id == 1; });
        if (has_it) {
            EXPECT_THROW(adapter.advance(window(0), responses), std::runtime_error);
        } else {
            EXPECT_NO_THROW(adapter.advance(window(0), responses));
            EXPECT_NO_THROW(adapter.apply_kick(window(0), {}));
        }
    });
}

}  // namespace
}  // namespace turbidite
