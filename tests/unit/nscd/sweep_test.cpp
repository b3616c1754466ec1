// SPDX-License-Identifier: LGPL-2.1-or-later
//
// However a sweep is done (in groups, by the vector unit, several at once, on threads), its bits
// are those of one contact after the other in the order given.
#include <gtest/gtest.h>

#include <cstring>
#include <numeric>
#include <random>
#include <set>

#include "granular_adapter/nscd/contact_order.hpp"
#include "granular_adapter/nscd/nlgs.hpp"
#include "granular_adapter/nscd/residual.hpp"
#include "granular_adapter/nscd/sweep_layout.hpp"
#include "granular_adapter/nscd/sweep_train.hpp"
#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

enum class Kind { discs, rolling_discs, general, general_rolling };

/// Bodies of a triangular lattice that random velocities press together; some immovable ones, some
/// contacts with a wall, some that cannot turn.
ContactProblem lattice(int columns, int rows, Kind kind) {
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    const bool general = kind == Kind::general || kind == Kind::general_rolling;
    ContactProblem problem;
    for (int i = 0; i < columns * rows; ++i) {
        BodyMobility body(1.0 + 0.5 * any(random), i % 11 == 0 ? 0.0 : 4.0 + any(random));
        if (i % 17 == 0) body = {};
        if (general && i % 17 != 0) body.xy = 0.2 * any(random), body.ys = 0.2 * any(random);
        problem.bodies.push_back(body);
        problem.free.push_back({{any(random), -1.0 + 0.3 * any(random), 0.0}, {0, 0, any(random)}});
    }
    const auto touch = [&](int a, int b, double angle) {
        if (b % 17 == 0 && (a < 0 || a % 17 == 0)) return;
        Contact c;
        c.a = a, c.b = b;
        c.normal = {std::cos(angle), std::sin(angle), 0.0};
        c.tangent = tangent_of(c.normal);
        const double skew = general ? 0.2 * any(random) : 0.0;
        c.arm_b = {-0.5 * c.normal[0] + skew * c.tangent[0],
                   -0.5 * c.normal[1] + skew * c.tangent[1], 0.0};
        if (a >= 0) c.arm_a = {-c.arm_b[0], -c.arm_b[1], 0.0};
        c.friction = 0.3 + 0.2 * any(random);
        c.bias = {0.3 * any(random), 0.0, 0.0};
        if (kind == Kind::rolling_discs || kind == Kind::general_rolling)
            c.rolling = a % 3 == 0 ? 0.0 : 0.05;
        problem.contacts.push_back(c);
    };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const int body = row * columns + column;
            if (row == 0) touch(-1, body, 1.5);
            if (column > 0) touch(body - 1, body, 0.01 * any(random));
            if (row > 0) touch(body - columns, body, 1.05 + 0.01 * any(random));
            if (row > 0 && column > 0) touch(body - columns - 1, body, 2.1);
        }
    std::shuffle(problem.contacts.begin(), problem.contacts.end(), random);
    return problem;
}

std::vector<std::int32_t> natural_order(const ContactProblem& problem) {
    std::vector<std::int32_t> order(problem.contacts.size());
    std::iota(order.begin(), order.end(), 0);
    return order;
}

template <class Rows>
SweepLayout<Rows> laid_out(const ContactProblem& problem, const Delassus& w, int distance,
                           std::size_t head) {
    const std::vector<MovedPair> pairs = moved_pairs(problem);
    const Impulses zero(problem.contacts.size());
    return {problem,
            w,
            pairs,
            zero,
            problem.free,
            make_schedule(pairs, natural_order(problem), head, problem.bodies.size(),
                          {Rows::width, distance})};
}

/// `head` contacts `count` times, all of them in between.
template <class Rows>
Impulses after_sweeps(const ContactProblem& problem, Instructions instructions, int distance,
                      std::size_t head, int threads) {
    const Delassus w(problem);
    SweepLayout<Rows> layout = laid_out<Rows>(problem, w, distance, head);
    SweepTrain<Rows> train(
        sweeps<Rows>(instructions), layout.rows, layout.bodies, layout.schedule,
        make_blocks(layout.schedule, moved_pairs(problem), problem.bodies.size(), Rows::width));
    ThreadTeam team(threads);
    train.run({{false, false}, {false, false}, {true, false}, {true, false}, {true, true}}, team);
    train.run({{false, false}, {true, true}}, team);
    Impulses r(problem.contacts.size());
    layout.collect(r);
    return r;
}

bool same_bits(const Impulses& a, const Impulses& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

bool moves_something(const Impulses& r) {
    return std::count_if(r.begin(), r.end(), [](const Vec3& x) { return x[0] > 0.0; }) >
           static_cast<std::ptrdiff_t>(r.size() / 4);
}

std::vector<Instructions> all_instructions() {
    if (available(Instructions::avx2)) return {Instructions::portable, Instructions::avx2};
    return {Instructions::portable};
}

/// The same through every way of doing it.
template <class Grouped, class Single>
void expect_the_bits_of_one_after_the_other(Kind kind) {
    const ContactProblem problem = lattice(30, 40, kind);
    const std::size_t head = problem.contacts.size() * 2 / 3;
    const Impulses reference = after_sweeps<Single>(problem, Instructions::portable, 1, head, 1);
    ASSERT_TRUE(moves_something(reference));
    for (const Instructions instructions : all_instructions())
        for (const int distance : {1, 2, 3, 7})
            for (const int threads : {1, 2, 3})
                EXPECT_TRUE(same_bits(reference, after_sweeps<Grouped>(problem, instructions,
                                                                       distance, head, threads)))
                    << static_cast<int>(instructions) << " " << distance << " " << threads;
}

TEST(Sweep, GroupsOfDiscsHaveTheBitsOfOneAfterTheOther) {
    expect_the_bits_of_one_after_the_other<DiscRows<4>, DiscRows<1>>(Kind::discs);
}

TEST(Sweep, GroupsOfRollingDiscsHaveTheBitsOfOneAfterTheOther) {
    expect_the_bits_of_one_after_the_other<RollingDiscRows<4>, RollingDiscRows<1>>(
        Kind::rolling_discs);
}

TEST(Sweep, GroupsOfGeneralRowsHaveTheBitsOfOneAfterTheOther) {
    expect_the_bits_of_one_after_the_other<GeneralRows<4>, GeneralRows<1>>(Kind::general);
}

TEST(Sweep, GeneralRollingRowsHaveTheBitsOfOneAfterTheOther) {
    expect_the_bits_of_one_after_the_other<GeneralRollingRows<1>, GeneralRollingRows<1>>(
        Kind::general_rolling);
}

/// Position of every contact in a schedule; fails on a contact twice or missing.
std::vector<std::int32_t> groups_of(const Schedule& schedule, std::size_t contacts, int width) {
    std::vector<std::int32_t> group(contacts, -1);
    for (std::size_t i = 0; i < schedule.lanes.size(); ++i) {
        const std::int32_t k = schedule.lanes[i];
        if (k < 0) continue;
        EXPECT_EQ(group[static_cast<std::size_t>(k)], -1) << "twice";
        group[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(i) / width;
    }
    EXPECT_EQ(std::count(group.begin(), group.end(), -1), 0);
    return group;
}

TEST(Schedule, KeepsTheOrderOfContactsThatShareABodyAndTheirDistance) {
    const ContactProblem problem = lattice(25, 25, Kind::discs);
    const std::vector<MovedPair> pairs = moved_pairs(problem);
    const std::size_t head = pairs.size() / 2;
    const Schedule schedule =
        make_schedule(pairs, natural_order(problem), head, problem.bodies.size(), {4, 3});
    const std::vector<std::int32_t> group = groups_of(schedule, pairs.size(), 4);
    EXPECT_EQ(schedule.lanes.size(), static_cast<std::size_t>(schedule.all) * 4);
    std::vector<std::int32_t> last(problem.bodies.size(), -3);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        EXPECT_EQ(k < head, group[k] < schedule.head);
        for (const std::int32_t body : {pairs[k].a, pairs[k].b}) {
            if (body < 0) continue;
            EXPECT_GE(group[k],
                      last[body] + (k == head ? 1 : 3) - (group[k] >= schedule.head ? 2 : 0));
            last[body] = group[k];
        }
    }
    // Discs have six neighbours: there is enough to do side by side.
    EXPECT_GT(pairs.size(), 0.7 * schedule.lanes.size());
}

// A body that everything touches: one contact per group, whatever the width.
TEST(Schedule, AHubIsServedOneContactAtATime) {
    std::vector<MovedPair> pairs;
    for (std::int32_t k = 1; k <= 200; ++k) pairs.push_back({0, k});
    std::vector<std::int32_t> order(pairs.size());
    std::iota(order.begin(), order.end(), 0);
    const Schedule schedule = make_schedule(pairs, order, pairs.size(), 201, {4, 3});
    const std::vector<std::int32_t> group = groups_of(schedule, pairs.size(), 4);
    for (std::size_t k = 1; k < group.size(); ++k) EXPECT_EQ(group[k], group[k - 1] + 3);
}

// Many contacts with immovable things only depend on nothing: all lanes are full.
TEST(Schedule, ImmovablePartnersDoNotBind) {
    std::vector<MovedPair> pairs;
    for (std::int32_t k = 0; k < 200; ++k) pairs.push_back({-1, k});
    std::vector<std::int32_t> order(pairs.size());
    std::iota(order.begin(), order.end(), 0);
    EXPECT_EQ(make_schedule(pairs, order, pairs.size(), 200, {4, 3}).all, 50);
}

// A row of discs at one height, then one a radius lower: the upper row first, its even contacts
// before its odd ones, so that no body is met twice within a colour.
TEST(ContactOrder, TakesARowByColoursFromTheTopDown) {
    Bodies bodies;
    std::vector<ContactPoint> points;
    for (int i = 0; i < 12; ++i) bodies.add(scenes::disc(i, i % 6, i < 6 ? 0.0 : 0.5));
    for (std::int32_t i = 0; i < 11; ++i) {
        if (i == 5) continue;
        ContactPoint point;
        point.a = i, point.b = i + 1;
        points.push_back(point);
    }
    order_top_down(points, bodies, {0.0, -9.81, 0.0}, 1e-3);
    std::vector<std::int32_t> first;
    for (const ContactPoint& point : points) first.push_back(point.a);
    EXPECT_EQ(first, (std::vector<std::int32_t>{6, 8, 10, 7, 9, 0, 2, 4, 1, 3}));
    order_top_down(points, bodies, {}, 1e-3);
    EXPECT_EQ(points[0].a, 6) << "without gravity nothing changes";
}

TEST(Sweep, MeasuresTheNaturalMapAlongTheWay) {
    for (const Kind kind : {Kind::discs, Kind::rolling_discs}) {
        // Contacts that share no body: the state that each meets is the start.
        ContactProblem problem = lattice(20, 20, kind);
        std::set<std::int32_t> met;
        std::erase_if(problem.contacts, [&](const Contact& c) {
            const bool free = !met.contains(c.b) && (c.a < 0 || !met.contains(c.a));
            if (free) met.insert(c.b), met.insert(c.a);
            return !free;
        });
        const Delassus w(problem);
        Impulses r(problem.contacts.size());
        for (std::size_t k = 0; k < r.size(); ++k)
            r[k] = {0.1 * double(k % 3), 0.02 * double(k % 2), w.block(k).rr > 0.0 ? 0.001 : 0.0};
        const std::vector<Twist> v = body_velocities(problem, r);
        const std::vector<MovedPair> pairs = moved_pairs(problem);
        const auto sum = [&]<class Rows>(Rows) {
            SweepLayout<Rows> layout(problem, w, pairs, r, v,
                                     make_schedule(pairs, natural_order(problem), r.size(),
                                                   problem.bodies.size(), {Rows::width, 1}));
            PassSums<Rows::width> sums;
            sweeps<Rows>(best_instructions())
                .measured(layout.rows.data(), layout.rows.data() + layout.rows.size(),
                          layout.bodies.data(), sums);
            return std::sqrt(total(sums.error) / total(sums.size));
        };
        const double expected = natural_map_residual(problem, r);
        if (kind == Kind::discs)
            EXPECT_NEAR(sum(DiscRows<4>()), expected, 1e-13 * expected);
        else
            EXPECT_NEAR(sum(RollingDiscRows<4>()), expected, 1e-13 * expected);
        EXPECT_GT(expected, 0.1);
    }
}

SolverSettings few_sweeps(std::int64_t threads) {
    SolverSettings settings;
    settings.tolerance = 1e-6;
    settings.max_iterations = 50;
    settings.threads = threads;
    return settings;
}

// Large enough for threads, the tail and a second layout on the way.
TEST(Nlgs, DependsOnNeitherThreadsNorInstructions) {
    for (const Kind kind : {Kind::discs, Kind::rolling_discs, Kind::general}) {
        const ContactProblem problem = lattice(50, 60, kind);
        const Impulses none(problem.contacts.size());
        const SolverResult reference =
            Nlgs(Instructions::portable).solve(problem, none, few_sweeps(1));
        EXPECT_TRUE(moves_something(reference.impulses));
        for (const Instructions instructions : all_instructions())
            for (const std::int64_t threads : {1, 2, 3}) {
                const SolverResult other =
                    Nlgs(instructions).solve(problem, none, few_sweeps(threads));
                EXPECT_TRUE(same_bits(reference.impulses, other.impulses));
                EXPECT_EQ(reference.iterations, other.iterations);
                EXPECT_EQ(reference.residual, other.residual);
                EXPECT_EQ(reference.change.quad, other.change.quad);
            }
    }
}

TEST(Nlgs, RefusesNoThreads) {
    EXPECT_THROW(Nlgs().solve(lattice(2, 2, Kind::discs), Impulses(5), few_sweeps(0)),
                 std::invalid_argument);
}

// Whatever the kind of rows, the published residual says that the contacts are solved.
TEST(Nlgs, SolvesEveryKindOfContact) {
    for (const Kind kind :
         {Kind::discs, Kind::rolling_discs, Kind::general, Kind::general_rolling}) {
        ContactProblem problem = lattice(8, 8, kind);
        // All of them jam the lattice, and need very many sweeps.
        problem.contacts.resize(problem.contacts.size() / 2);
        SolverSettings settings;
        settings.tolerance = 1e-9;
        settings.max_iterations = 100000;
        const SolverResult result =
            Nlgs().solve(problem, Impulses(problem.contacts.size()), settings);
        EXPECT_TRUE(result.converged) << static_cast<int>(kind);
        EXPECT_LE(natural_map_residual(problem, result.impulses), 1e-9);
        EXPECT_EQ(natural_map_residual(problem, result.impulses), result.residual);
        EXPECT_TRUE(moves_something(result.impulses));
    }
}

}  // namespace
}  // namespace turbidite::nscd
