// SPDX-License-Identifier: LGPL-2.1-or-later
//
// However a sweep over spheres is executed (in groups, vectorised, several at once, by threads),
// the result is bitwise that of one contact after the other in the given order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "granular_adapter/nscd/solvers/nlgs.hpp"
#include "granular_adapter/nscd/sweeps/cell_schedule.hpp"
#include "granular_adapter/nscd/sweeps/space/sphere_pack.hpp"
#include "granular_adapter/nscd/sweeps/sweep_pipeline.hpp"
#include "spheres.hpp"

namespace turbidite::nscd {
namespace {

/// A cubic array of n^3 spheres pressed together by random velocities, contacts in any order; some
/// are immovable, some cannot rotate.
ContactProblem heap(int n, bool biased, bool turning = false) {
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    ContactProblem problem;
    std::vector<SpaceMobility> bodies;
    const auto touch = [&](int a, int b, Vec3 normal) {
        for (double& component : normal) component += 0.1 * any(random);
        normal = (1.0 / norm(normal)) * normal;
        Contact c;
        c.a = a, c.b = b, c.normal = normal, c.tangent = tangent_of(normal);
        if (a >= 0) c.arm_a = (0.5 + 0.1 * any(random)) * normal;
        c.arm_b = (-0.5 + 0.1 * any(random)) * normal;
        c.friction = 0.3 + 0.2 * any(random);
        c.bias.n = 0.3 * any(random);
        if (biased) c.bias.t = 0.2 * any(random), c.bias.s = 0.2 * any(random);
        if (turning && a % 3 != 0) c.rolling = 0.05, c.torsion = 0.03;
        problem.contacts.push_back(c);
    };
    const auto immovable = [](int i) { return i < 0 || i % 17 == 0; };
    for (int i = 0; i < n * n * n; ++i) {
        SpaceMobility body{1.0 + 0.5 * any(random), i % 11 == 0 ? 0.0 : 4.0 + any(random)};
        if (immovable(i)) body = {};
        bodies.push_back(body);
        problem.free.push_back({{any(random), -1.0 + 0.3 * any(random), any(random)},
                                {any(random), any(random), any(random)}});
        const int x = i % n, y = i / n % n, z = i / (n * n);
        for (const auto& [partner, normal] : {std::pair{y > 0 ? i - n : -1, Vec3{0, 1, 0}},
                                              {x > 0 ? i - 1 : i, Vec3{1, 0, 0}},
                                              {z > 0 ? i - n * n : i, Vec3{0, 0, 1}}})
            if (partner != i && !(immovable(i) && immovable(partner))) touch(partner, i, normal);
    }
    problem.bodies = std::move(bodies);
    std::shuffle(problem.contacts.begin(), problem.contacts.end(), random);
    return problem;
}

/// The same with films at three contacts of four.
ContactProblem filmed_heap(int n, bool turning) {
    ContactProblem problem = heap(n, true, turning);
    std::mt19937_64 random(10);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    for (std::size_t k = 0; k < problem.contacts.size(); ++k) {
        const double gap = 0.02 + any(random);
        problem.films.push_back(k % 4 == 0 ? Film() : Film{0.2 * any(random), gap, 1.5, 0.3 * gap});
    }
    return problem;
}

std::vector<MovedPair> moved_pairs(const ContactProblem& problem, const SphereOperator& w) {
    const MovedBodies moved(w.bodies());
    std::vector<MovedPair> pairs;
    for (const Contact& contact : problem.contacts) pairs.push_back(moved.of(contact));
    return pairs;
}

/// All contacts active.
template <class Rows>
SweepLayout<Rows> laid_out(const ContactProblem& problem, const SphereOperator& w, int stretch) {
    const std::vector<MovedPair> pairs = moved_pairs(problem, w);
    const std::vector<std::uint8_t> active(pairs.size(), 1);
    Schedule schedule =
        make_schedule(pairs, active, w.bodies().size(), {.width = Rows::width, .stretch = stretch});
    return {problem, w, pairs, Impulses(pairs.size()), problem.free, std::move(schedule)};
}

constexpr std::size_t sweeps_per_run = 5;

template <class Rows>
struct Outcome {
    Impulses r;
    PassSums<Rows::width> sums;
};

template <class Rows>
Outcome<Rows> after_a_run(const ContactProblem& problem, Instructions instructions, int threads) {
    const SphereOperator w(problem);
    SweepLayout<Rows> layout = laid_out<Rows>(problem, w, 100);
    SweepPipeline<Rows> pipeline(sweeps<Rows>(instructions), layout);
    ThreadTeam team(threads);
    pipeline.run(sweeps_per_run, team);
    Impulses r(problem.contacts.size());
    layout.collect(r);
    return {r, pipeline.active_sums()};
}

/// The reference: single contacts in their order.
template <class Rows>
Impulses one_after_the_other(const ContactProblem& problem) {
    const SphereOperator w(problem);
    SweepLayout<Rows> layout =
        laid_out<Rows>(problem, w, static_cast<int>(problem.contacts.size()));
    const auto plain = sweeps<Rows>(Instructions::portable).plain;
    std::vector<Rows*> in_order(problem.contacts.size());
    for (std::size_t i = 0; i < layout.schedule.lanes.size(); ++i)
        if (const std::int32_t k = layout.schedule.lanes[i]; k >= 0)
            in_order[static_cast<std::size_t>(k)] = &layout.rows[i];
    for (std::size_t s = 0; s < sweeps_per_run; ++s)
        for (Rows* const row : in_order) plain(row, row + 1, layout.bodies.data());
    Impulses r(problem.contacts.size());
    layout.collect(r);
    return r;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool same_bits(const Impulses& a, const Impulses& b) {
    return same_bits<ContactVector>(a, b) && same_bits(a.moments, b.moments);
}

std::vector<Instructions> all_instructions() {
    if (available(Instructions::avx2)) return {Instructions::portable, Instructions::avx2};
    return {Instructions::portable};
}

template <class Grouped, class Single>
void expect_the_bits_of_one_after_the_other(const ContactProblem& problem) {
    const Impulses reference = one_after_the_other<Single>(problem);
    int pressed = 0, loaded = 0, sliding = 0;
    for (std::size_t k = 0; k < reference.size(); ++k) {
        const double limit = problem.contacts[k].friction * reference[k].n;
        pressed += reference[k].n > 0.0, loaded += reference[k].n != 0.0;
        sliding += reference[k].n > 0.0 && tangential(reference[k]) > limit * (1 - 1e-9);
    }
    ASSERT_GT(pressed, static_cast<int>(reference.size() / 4));
    ASSERT_GT(sliding, pressed / 10);
    ASSERT_LT(sliding, 9 * pressed / 10);
    for (const Instructions instructions : all_instructions())
        for (const int threads : {1, 2, 3}) {
            const auto run = after_a_run<Grouped>(problem, instructions, threads);
            EXPECT_TRUE(same_bits(reference, run.r))
                << static_cast<int>(instructions) << " " << threads;
            EXPECT_GT(total(run.sums.size), 0.0);
            EXPECT_EQ(total(run.sums.loaded), loaded);
        }
}

template <class Grouped, class Single>
void expect_the_bits_of_one_after_the_other(bool biased, bool turning = false) {
    expect_the_bits_of_one_after_the_other<Grouped, Single>(heap(12, biased, turning));
}

TEST(SphereSweep, GroupsHaveTheBitsOfOneAfterTheOther) {
    expect_the_bits_of_one_after_the_other<SphereRows<4>, SphereRows<1>>(false);
}

TEST(SphereSweep, GroupsWithTangentialBiasHaveTheBitsOfOneAfterTheOther) {
    expect_the_bits_of_one_after_the_other<BiasedSphereRows<4>, BiasedSphereRows<1>>(true);
}

TEST(SphereSweep, GroupsWithMomentsHaveTheBitsOfOneAfterTheOther) {
    expect_the_bits_of_one_after_the_other<TurningSphereRows<4>, TurningSphereRows<1>>(true, true);
    const Impulses r =
        after_a_run<TurningSphereRows<4>>(heap(12, true, true), best_instructions(), 1).r;
    EXPECT_GT(std::count_if(r.moments.begin(), r.moments.end(),
                            [](const Vec3& m) { return norm(m) > 1e-4; }),
              200);
}

TEST(SphereSweep, GroupsWithFilmsHaveTheBitsOfOneAfterTheOther) {
    for (const bool turning : {false, true}) {
        const ContactProblem problem = filmed_heap(12, turning);
        expect_the_bits_of_one_after_the_other<FilmSphereRows<4>, FilmSphereRows<1>>(problem);
        const Impulses r = after_a_run<FilmSphereRows<4>>(problem, best_instructions(), 1).r;
        EXPECT_GT(
            std::count_if(r.begin(), r.end(), [](const ContactVector& x) { return x.n < 0.0; }),
            100)
            << "films that part";
    }
}

// The rows with a tangential bias give the others' result where there is none.
TEST(SphereSweep, BothKindsOfRowsAgree) {
    const ContactProblem problem = heap(8, false);
    const Impulses plain = after_a_run<SphereRows<4>>(problem, best_instructions(), 1).r;
    const Impulses biased = after_a_run<BiasedSphereRows<4>>(problem, best_instructions(), 1).r;
    EXPECT_EQ(plain, biased);
}

// The sums of a sweep at rest are the map of residual.hpp.
TEST(SphereSweep, TheSumsOfASolvedProblemTellItsResidual) {
    for (const auto& [problem, moments] :
         {std::pair{heap(16, true), false}, std::pair{heap(16, true, true), true},
          std::pair{filmed_heap(16, false), true}, std::pair{filmed_heap(16, true), true}}) {
        SolverSettings settings;
        settings.tolerance = 1e-3;
        const SolverResult solved =
            Nlgs().solve(problem, Impulses(problem.contacts.size()), settings);
        ASSERT_TRUE(solved.converged);
        EXPECT_GT(solved.iterations, 10);
        EXPECT_EQ(natural_map_residual(problem, solved.impulses), solved.residual);
        EXPECT_EQ(solved.impulses.moments.empty(), !moments);
    }
}

/// For any instructions and threads bitwise the same, in problems large enough for several threads.
void solves_alike(const ContactProblem& problem) {
    ASSERT_GT(problem.contacts.size(), 6000u);
    const Impulses guess(problem.contacts.size());
    SolverSettings settings;
    settings.momentum_after = 16;
    const SolverResult reference = Nlgs(Instructions::portable).solve(problem, guess, settings);
    EXPECT_TRUE(reference.converged);
    EXPECT_GT(reference.iterations, 24) << "with momentum";
    for (const Instructions instructions : all_instructions())
        for (const int threads : {1, 2, 3}) {
            settings.threads = threads;
            const SolverResult result = Nlgs(instructions).solve(problem, guess, settings);
            EXPECT_TRUE(same_bits(result.impulses, reference.impulses));
            EXPECT_EQ(result.iterations, reference.iterations);
            EXPECT_EQ(result.residual, reference.residual);
        }
}

// A whole solve, with resting groups that wake and new layouts.
TEST(SphereSweep, SolvesAreTheSameForAllInstructionsAndThreads) {
    solves_alike(heap(16, true));
}

/// A heap in cells of 3 x 3 x 3 bodies, in the order of their parities.
ContactProblem heap_in_cells(int n) {
    ContactProblem problem = heap(n, true);
    const auto place = [n](const Contact& contact) {
        const int x = contact.b % n / 3, y = contact.b / n % n / 3, z = contact.b / (n * n) / 3;
        const int parity = (x & 1) << 2 | (z & 1) << 1 | (y & 1);
        return static_cast<std::uint64_t>(((parity * n + x) * n + z) * n + y);
    };
    std::stable_sort(
        problem.contacts.begin(), problem.contacts.end(),
        [&](const Contact& one, const Contact& two) { return place(one) < place(two); });
    ContactCells& cells = problem.cells;
    for (std::size_t k = 0; k < problem.contacts.size(); ++k) {
        if (cells.empty() || place(problem.contacts[k]) != cells.place.back()) {
            cells.place.push_back(place(problem.contacts[k]));
            cells.end.push_back(0);
        }
        cells.end.back() = static_cast<std::int32_t>(k) + 1;
    }
    return problem;
}

TEST(SphereSweep, SolvesByCellsAreTheSameForAllInstructionsAndThreads) {
    solves_alike(heap_in_cells(16));
}

// Any two stretches that share a body are in the order of the schedule, and every thread has work.
TEST(SphereSweep, LayersKeepTheOrderOfStretchesThatShareABody) {
    const ContactProblem problem = heap_in_cells(10);
    const SphereOperator w(problem);
    const std::vector<MovedPair> pairs = moved_pairs(problem, w);
    const std::vector<std::uint8_t> active(pairs.size(), 1);
    const SweepLayout<SphereRows<4>> layout(
        problem, w, pairs, Impulses(pairs.size()), problem.free,
        make_cell_schedule(pairs, active, w.bodies().size(), {}, problem.cells));
    const StretchLayers laid(layout, 2);

    std::vector<std::size_t> layer_of(layout.schedule.stretches.size());
    std::size_t found = 0, with_work_for_two = 0;
    for (std::size_t layer = 0; layer < laid.layers.size(); ++layer) {
        for (const std::vector<std::size_t>& part : laid.layers[layer])
            for (const std::size_t s : part) layer_of[s] = layer, ++found;
        with_work_for_two += !laid.layers[layer][0].empty() && !laid.layers[layer][1].empty();
    }
    EXPECT_EQ(found, layer_of.size());
    EXPECT_LE(laid.layers.size(), 8u) << "parities";
    EXPECT_EQ(with_work_for_two, laid.layers.size());
    std::vector<std::int64_t> last(w.bodies().size(), -1);  // layer, by body
    for (std::size_t s = 0; s < layer_of.size(); ++s) {
        const GroupRange groups = layout.schedule.stretches[s].active;
        std::vector<std::int32_t> bodies;
        for (std::int32_t i = 4 * groups.first; i < 4 * groups.last; ++i)
            if (const std::int32_t k = layout.schedule.lanes[static_cast<std::size_t>(i)]; k >= 0)
                for (const std::int32_t body : {pairs[k].a, pairs[k].b})
                    if (body >= 0) bodies.push_back(body);
        for (const std::int32_t body : bodies)
            EXPECT_LT(last[body], static_cast<std::int64_t>(layer_of[s])) << s;
        for (const std::int32_t body : bodies) last[body] = static_cast<std::int64_t>(layer_of[s]);
    }
}

}  // namespace
}  // namespace turbidite::nscd
