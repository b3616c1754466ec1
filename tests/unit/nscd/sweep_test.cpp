// SPDX-License-Identifier: LGPL-2.1-or-later
//
// However a sweep is executed (in groups, vectorised, several at once, by threads), the result is
// bitwise that of one contact after the other in the given order.
#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <random>
#include <set>

#include "granular_adapter/nscd/detection/contact_order.hpp"
#include "granular_adapter/nscd/problem/residual.hpp"
#include "granular_adapter/nscd/solvers/nlgs.hpp"
#include "granular_adapter/nscd/sweeps/plane/sweep_pack.hpp"
#include "granular_adapter/nscd/sweeps/sweep_pipeline.hpp"
#include "planar.hpp"
#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

enum class Kind { discs, rolling_discs, general, general_rolling, filmed };

/// Bodies of a triangular lattice pressed together by random velocities; some are immovable, some
/// have contacts with a wall, some cannot rotate.
ContactProblem lattice(int columns, int rows, Kind kind) {
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    const bool general = kind != Kind::discs && kind != Kind::rolling_discs;
    ContactProblem problem;
    for (int i = 0; i < columns * rows; ++i) {
        BodyMobility body(1.0 + 0.5 * any(random), i % 11 == 0 ? 0.0 : 4.0 + any(random));
        if (i % 17 == 0) body = {};
        if (general && i % 17 != 0) body.xy = 0.2 * any(random), body.ys = 0.2 * any(random);
        planar::bodies(problem).push_back(body);
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
        c.bias = in_plane(0.3 * any(random), 0.0);
        if (kind != Kind::discs && kind != Kind::general) c.rolling = a % 3 == 0 ? 0.0 : 0.05;
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
    if (kind == Kind::filmed)
        for (const Contact& c : problem.contacts) {
            const double gap = 0.3 + 0.2 * any(random);
            Film film{0.05, gap, 0.8, gap - c.bias.n + 0.5, FilmBetween::discs};
            problem.films.push_back(any(random) < -0.3 ? Film() : film);
        }
    return problem;
}

/// Two thirds of the contacts are active, mixed with the others.
std::vector<std::uint8_t> two_thirds(std::size_t contacts) {
    std::vector<std::uint8_t> active(contacts);
    for (std::size_t k = 0; k < contacts; ++k) active[k] = (k / 5) % 3 != 0 ? 1 : 0;
    return active;
}

std::vector<MovedPair> moved_pairs(const ContactProblem& problem) {
    const MovedBodies moved(planar::bodies(problem));
    std::vector<MovedPair> pairs;
    for (const Contact& contact : problem.contacts) pairs.push_back(moved.of(contact));
    return pairs;
}

Schedule scheduled(const ContactProblem& problem, const ScheduleSettings& settings) {
    return make_schedule(moved_pairs(problem), two_thirds(problem.contacts.size()),
                         size(problem.bodies), settings);
}

template <class Rows>
SweepLayout<Rows> laid_out(const ContactProblem& problem, const Delassus& w, Schedule schedule) {
    return {problem,
            w,
            moved_pairs(problem),
            Impulses(problem.contacts.size()),
            problem.free,
            std::move(schedule)};
}

template <class Layout>
void wake_some(Layout& layout) {
    for (std::size_t g = 0; g < layout.awake.size(); ++g) layout.awake[g] = g % 3 == 0 ? 1 : 0;
}

constexpr int runs = 2;
constexpr std::size_t sweeps_per_run = 5;

template <class Rows>
Impulses after_runs(const ContactProblem& problem, Instructions instructions,
                    const Schedule& schedule, int threads) {
    const Delassus w(problem);
    SweepLayout<Rows> layout = laid_out<Rows>(problem, w, schedule);
    wake_some(layout);
    SweepPipeline<Rows> pipeline(sweeps<Rows>(instructions), layout);
    ThreadTeam team(threads);
    for (int i = 0; i < runs; ++i) pipeline.run(sweeps_per_run, team);
    Impulses r(problem.contacts.size());
    layout.collect(r);
    return r;
}

/// The reference for pipelines: one contact after the other.
template <class Rows>
class OneByOne {
 public:
    OneByOne(const ContactProblem& problem, const Schedule& grouped)
        : grouped_(grouped),
          w_(problem),
          layout_(laid_out<Rows>(problem, w_, single_lanes(problem, grouped))) {
        for (std::int32_t g = grouped.active; g < grouped.all; ++g)
            awake_.push_back((g - grouped.active) % 3 == 0);
    }

    Impulses after_runs(std::size_t contacts) {
        for (int i = 0; i < runs; ++i)
            for (std::size_t s = 0; s < sweeps_per_run; ++s) sweep(s + 1 == sweeps_per_run);
        Impulses r(contacts);
        layout_.collect(r);
        return r;
    }

 private:
    /// Memory in the order of the contacts, all of them active.
    static Schedule single_lanes(const ContactProblem& problem, const Schedule& grouped) {
        Schedule schedule;
        for (std::size_t k = 0; k < problem.contacts.size(); ++k)
            schedule.lanes.push_back(static_cast<std::int32_t>(k));
        schedule.active = schedule.all = static_cast<std::int32_t>(problem.contacts.size());
        EXPECT_GT(grouped.stretches.size(), 2u);
        return schedule;
    }

    void sweep(bool last) {
        for (const Stretch& stretch : grouped_.stretches) {
            for (std::int32_t g = stretch.active.first; g < stretch.active.last; ++g) update(g);
            for (std::int32_t g = stretch.resting.first; g < stretch.resting.last; ++g) {
                const auto place = static_cast<std::size_t>(g - grouped_.active);
                if (!last && !awake_[place]) continue;
                const bool loaded = update(g);
                if (last) awake_[place] = loaded;
            }
        }
    }

    bool update(std::int32_t group) {
        const auto width = static_cast<std::int32_t>(grouped_.lanes.size()) / grouped_.all;
        bool loaded = false;
        for (std::int32_t i = group * width; i < (group + 1) * width; ++i) {
            const std::int32_t k = grouped_.lanes[static_cast<std::size_t>(i)];
            if (k < 0) continue;
            Rows* const row = layout_.rows.data() + k;
            plain_(row, row + 1, layout_.bodies.data());
            loaded = loaded || row->rn.v[0] != 0.0;
        }
        return loaded;
    }

    const Schedule& grouped_;
    Delassus w_;
    SweepLayout<Rows> layout_;
    std::vector<bool> awake_;
    void (*plain_)(Rows*, Rows*, PlaneBody*) = sweeps<Rows>(Instructions::portable).plain;
};

bool same_bits(const Impulses& a, const Impulses& b) {
    return a.size() == b.size() &&
           std::memcmp(a.data(), b.data(), a.size() * sizeof(ContactVector)) == 0;
}

bool moves_something(const Impulses& r) {
    return std::count_if(r.begin(), r.end(), [](const ContactVector& x) { return x.n > 0.0; }) >
           static_cast<std::ptrdiff_t>(r.size() / 4);
}

std::vector<Instructions> all_instructions() {
    if (available(Instructions::avx2)) return {Instructions::portable, Instructions::avx2};
    return {Instructions::portable};
}

/// The same in every way of execution.
template <class Grouped, class Single>
void expect_the_bits_of_one_after_the_other(Kind kind) {
    const ContactProblem problem = lattice(30, 40, kind);
    for (const int distance : {1, 2, 3, 7}) {
        const Schedule schedule =
            scheduled(problem, {.width = Grouped::width, .distance = distance, .stretch = 100});
        const Impulses reference =
            OneByOne<Single>(problem, schedule).after_runs(problem.contacts.size());
        ASSERT_TRUE(moves_something(reference));
        for (const Instructions instructions : all_instructions())
            for (const int threads : {1, 2, 3})
                EXPECT_TRUE(same_bits(
                    reference, after_runs<Grouped>(problem, instructions, schedule, threads)))
                    << static_cast<int>(instructions) << " " << distance << " " << threads;
    }
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

TEST(Sweep, AnyRowsHaveTheBitsOfOneAfterTheOther) {
    for (const Kind kind : {Kind::general_rolling, Kind::filmed})
        expect_the_bits_of_one_after_the_other<AnyRows<1>, AnyRows<1>>(kind);
}

/// Position of every contact in a schedule; fails if a contact is missing or occurs twice.
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
    const std::vector<std::uint8_t> active = two_thirds(pairs.size());
    const Schedule schedule = scheduled(problem, {.width = 4, .distance = 3});
    const std::vector<std::int32_t> group = groups_of(schedule, pairs.size(), 4);
    EXPECT_EQ(schedule.lanes.size(), static_cast<std::size_t>(schedule.all) * 4);
    for (const bool resting : {false, true}) {
        std::vector<std::int32_t> last(size(problem.bodies), -3);
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            EXPECT_EQ(active[k] != 0, group[k] < schedule.active);
            if ((active[k] == 0) != resting) continue;
            for (const std::int32_t body : {pairs[k].a, pairs[k].b}) {
                if (body < 0) continue;
                EXPECT_GE(group[k], last[body] + 3);
                last[body] = group[k];
            }
        }
    }
    // Discs have six neighbours: enough independent contacts exist.
    EXPECT_GT(pairs.size(), 0.7 * schedule.lanes.size());
}

// A sweep that waits for `after` stretches of the one before sees everything these do to its
// bodies, and nothing of what the others will do.
TEST(Schedule, StretchesCoverAllGroupsAndKnowWhatTheyWaitFor) {
    const ContactProblem problem = lattice(25, 25, Kind::discs);
    const std::vector<MovedPair> pairs = moved_pairs(problem);
    const Schedule schedule = scheduled(problem, {.width = 4, .distance = 2, .stretch = 64});
    std::vector<std::int32_t> last(size(problem.bodies), 0);
    std::vector<std::set<std::int32_t>> bodies;
    GroupRange active{0, 0}, resting{schedule.active, schedule.active};
    for (const Stretch& stretch : schedule.stretches) {
        EXPECT_EQ(stretch.active.first, active.last);
        EXPECT_EQ(stretch.resting.first, resting.last);
        active = stretch.active, resting = stretch.resting;
        bodies.emplace_back();
        for (const GroupRange& range : {active, resting})
            for (std::int32_t i = 4 * range.first; i < 4 * range.last; ++i) {
                const std::int32_t k = schedule.lanes[static_cast<std::size_t>(i)];
                if (k < 0) continue;
                for (const std::int32_t body : {pairs[k].a, pairs[k].b})
                    if (body >= 0)
                        bodies.back().insert(body),
                            last[body] = static_cast<std::int32_t>(bodies.size());
            }
    }
    EXPECT_EQ(active.last, schedule.active);
    EXPECT_EQ(resting.last, schedule.all);
    ASSERT_GT(bodies.size(), 10u);
    for (std::size_t s = 0; s < bodies.size(); ++s) {
        std::int32_t needed = 0;
        for (const std::int32_t body : bodies[s]) needed = std::max(needed, last[body]);
        EXPECT_EQ(schedule.stretches[s].after, needed);
    }
}

// One body in all contacts: one contact per group, whatever the width.
TEST(Schedule, ABodyInAllContactsHasOneContactPerGroup) {
    std::vector<MovedPair> pairs;
    for (std::int32_t k = 1; k <= 200; ++k) pairs.push_back({0, k});
    const Schedule schedule = make_schedule(pairs, std::vector<std::uint8_t>(200, 1), 201, {4, 3});
    const std::vector<std::int32_t> group = groups_of(schedule, pairs.size(), 4);
    for (std::size_t k = 1; k < group.size(); ++k) EXPECT_EQ(group[k], group[k - 1] + 3);
}

// Many contacts with only immovable partners are independent: all lanes are used.
TEST(Schedule, ImmovablePartnersDoNotBind) {
    std::vector<MovedPair> pairs;
    for (std::int32_t k = 0; k < 200; ++k) pairs.push_back({-1, k});
    EXPECT_EQ(make_schedule(pairs, std::vector<std::uint8_t>(200, 1), 200, {4, 3}).all, 50);
}

// A layer of discs at one height, and another one a radius lower: the upper layer comes first, its
// even contacts before its odd ones, so that no body occurs twice within a colour.
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
    TopDownOrder down(bodies, {0.0, -9.81, 0.0}, 1e-3), without(bodies, {}, 1e-3);
    ThreadTeam alone(1);
    points = sorted_by(down, points, alone);
    std::vector<std::int32_t> first;
    for (const ContactPoint& point : points) first.push_back(point.a);
    EXPECT_EQ(first, (std::vector<std::int32_t>{6, 8, 10, 7, 9, 0, 2, 4, 1, 3}));
    points = sorted_by(without, points, alone);
    EXPECT_EQ(points[0].a, 6) << "without gravity nothing changes";
}

TEST(Sweep, MeasuresTheNaturalMapAlongTheWay) {
    for (const Kind kind : {Kind::discs, Kind::rolling_discs}) {
        // Contacts that share no body: each one sees the initial state.
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
            r[k] = in_plane(0.1 * double(k % 3), 0.02 * double(k % 2),
                            w.block(k).rr > 0.0 ? 0.001 : 0.0);
        const std::vector<Twist> v = body_velocities(problem, r);
        const std::vector<MovedPair> pairs = moved_pairs(problem);
        const auto sum = [&]<class Rows>(Rows) {
            SweepLayout<Rows> layout(problem, w, pairs, r, v,
                                     make_schedule(pairs, std::vector<std::uint8_t>(r.size(), 1),
                                                   size(problem.bodies), {Rows::width, 1}));
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

template <class Rows>
void expect_state_survives_rearrangement(Kind kind) {
    const ContactProblem problem = lattice(12, 12, kind);
    const std::vector<MovedPair> pairs = moved_pairs(problem);
    const Delassus w(problem);
    Schedule first = scheduled(problem, {.width = Rows::width, .distance = 1, .stretch = 40});
    SweepLayout<Rows> layout = laid_out<Rows>(problem, w, std::move(first));
    SweepPipeline<Rows> pipeline(sweeps<Rows>(best_instructions()), layout);
    ThreadTeam team(1);
    pipeline.run(3, team);
    Impulses before(pairs.size()), after(pairs.size());
    layout.collect(before);
    const std::vector<std::uint8_t> loaded = layout.loaded(pairs.size());
    for (std::size_t k = 0; k < pairs.size(); ++k) EXPECT_EQ(loaded[k] != 0, before[k].n != 0.0);
    layout.rearrange(make_schedule(pairs, loaded, size(problem.bodies),
                                   {.width = Rows::width, .distance = 3, .stretch = 70}));
    layout.collect(after);
    EXPECT_TRUE(same_bits(before, after));
    // However often: the bodies of empty lanes are not added to those of the layout before.
    const std::size_t bodies = layout.bodies.size();
    layout.rearrange(layout.schedule);
    EXPECT_EQ(layout.bodies.size(), bodies);
    // The rows were moved to the new layout: a layout made from scratch gives the same result apart
    // from rounded velocities.
    SweepLayout<Rows> fresh(problem, w, pairs, before, body_velocities(problem, before),
                            layout.schedule);
    SweepPipeline<Rows> other(sweeps<Rows>(best_instructions()), fresh);
    pipeline.run(4, team);
    other.run(4, team);
    Impulses expected(pairs.size());
    layout.collect(after);
    fresh.collect(expected);
    for (std::size_t k = 0; k < pairs.size(); ++k)
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(planar::component(after[k], i), planar::component(expected[k], i), 1e-12);
    EXPECT_TRUE(moves_something(after));
}

TEST(SweepLayout, GoesOnFromTheSameStateInOtherGroups) {
    expect_state_survives_rearrangement<DiscRows<4>>(Kind::discs);
    expect_state_survives_rearrangement<RollingDiscRows<4>>(Kind::rolling_discs);
    expect_state_survives_rearrangement<GeneralRows<4>>(Kind::general);
    expect_state_survives_rearrangement<AnyRows<1>>(Kind::general_rolling);
    expect_state_survives_rearrangement<AnyRows<1>>(Kind::filmed);
}

// An inactive contact is not swept until a measuring sweep finds that it closes.
TEST(SweepPipeline, ReactivatesClosingContacts) {
    ContactProblem problem;
    planar::bodies(problem).push_back(BodyMobility(1.0, 2.0));
    problem.free.push_back({{0.0, -1.0, 0.0}, {}});
    Contact floor;
    floor.b = 0;
    floor.normal = {0.0, 1.0, 0.0};
    floor.tangent = tangent_of(floor.normal);
    floor.arm_b = {0.0, -0.5, 0.0};
    problem.contacts.push_back(floor);
    const Delassus w(problem);
    const Schedule schedule = make_schedule(moved_pairs(problem), {0}, 1, {.width = 4});
    EXPECT_EQ(schedule.active, 0);
    SweepLayout<DiscRows<4>> layout = laid_out<DiscRows<4>>(problem, w, schedule);
    SweepPipeline<DiscRows<4>> pipeline(sweeps<DiscRows<4>>(best_instructions()), layout);
    ThreadTeam team(1);
    Impulses r(1);
    pipeline.run(1, team);
    layout.collect(r);
    EXPECT_EQ(r[0].n, 1.0);
    EXPECT_EQ(layout.awake, std::vector<std::uint8_t>{1});
    EXPECT_EQ(total(pipeline.resting_sums().loaded), 1.0);
    EXPECT_GT(total(pipeline.resting_sums().error), 0.0) << "the state that it met was not solved";
}

SolverSettings few_sweeps(std::int64_t threads) {
    SolverSettings settings;
    settings.tolerance = 1e-6;
    settings.max_iterations = 50;
    settings.threads = threads;
    return settings;
}

// Large enough for threads, for incomplete groups, and for a second layout during the solve.
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

// After all threads have ended; and the team goes on.
TEST(ThreadTeam, ThrowsWhatAThreadHasThrown) {
    ThreadTeam team(3);
    std::atomic<int> ended{0};
    for (const int thrower : {0, 2})
        EXPECT_THROW(team.run([&](int thread) {
            ++ended;
            if (thread == thrower) throw std::domain_error("here");
        }),
                     std::domain_error);
    EXPECT_EQ(ended, 6);
    team.run([&](int) { ++ended; });
    EXPECT_EQ(ended, 9);
}

TEST(Nlgs, RefusesNoThreads) {
    EXPECT_THROW(Nlgs().solve(lattice(2, 2, Kind::discs), Impulses(5), few_sweeps(0)),
                 std::invalid_argument);
}

// For every kind of rows, the published residual shows that the contacts are solved.
TEST(Nlgs, SolvesEveryKindOfContact) {
    for (const Kind kind :
         {Kind::discs, Kind::rolling_discs, Kind::general, Kind::general_rolling, Kind::filmed}) {
        ContactProblem problem = lattice(8, 8, kind);
        // With all of them the lattice jams, and needs very many sweeps.
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
