// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles that fall into a box: pairs touch at two points of a side, normal and tangent are
// coupled (W_nt != 0), and the pile is hyperstatic.
#include <gtest/gtest.h>

#include <map>

#include "granular_adapter/nscd/problem/plane/delassus_matrix.hpp"
#include "granular_adapter/nscd/problem/residual.hpp"
#include "judged.hpp"
#include "polygons.hpp"
#include "unique_impulses.hpp"

namespace turbidite {
namespace {

using namespace judged;
using nscd::ContactProblem;

constexpr double step = 0.01, width = 5.5, height = 16.0;
constexpr int triangles = 16;

/// During the fall, at landings, and in the pile; dimensionless.
std::vector<Named> problems_of_triangles() {
    nscd::EngineSettings settings = nscd::scenes::exact(0.8, 1e-3);
    settings.solver_settings.max_iterations = 2000;
    nscd::Engine engine = nscd::scenes::falling_triangles(triangles, width, height, settings);
    const siconos::Scale scale{engine.bodies().mass.front(), step};
    std::vector<Named> list;
    double now = 0.0;
    for (const double time : {2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 7.0}) {
        nscd::scenes::run(engine, time - now, step);
        now = time;
        list.push_back(
            {"t = " + std::to_string(time), siconos::dimensionless(engine.problem(), scale)});
    }
    return list;
}

/// Largest |W_nt| / sqrt(W_nn W_tt).
double coupling(const ContactProblem& problem) {
    const nscd::DelassusMatrix w(problem);
    double largest = 0.0;
    for (const nscd::Block& block : w.diagonal)
        largest = std::max(largest, std::abs(block.nt) / std::sqrt(block.nn * block.tt));
    return largest;
}

/// Number of contact points of pairs that touch at two points.
int points_of_sides(const ContactProblem& problem) {
    std::map<std::pair<int, int>, int> points;
    for (const nscd::Contact& c : problem.contacts)
        if (c.a >= 0) ++points[{c.a, c.b}];
    int count = 0;
    for (const auto& [pair, number] : points) count += number > 1 ? number : 0;
    return count;
}

/// One problem solved by both codes.
struct Judgement {
    const Named& named;
    const siconos::Problem judge{named.problem, {}};
    const siconos::Solution theirs = judge.solve("nsgs", 1e-7, 100000);
    std::vector<double> u;  ///< for Siconos' impulses
    std::vector<bool> unique;

    explicit Judgement(const Named& n) : named(n) {
        judge.error(theirs.impulses, &u);
        unique = unique_impulses(judge, u, 1e-5 * norm(u));
    }

    void compare(const std::string& solver) const {
        SCOPED_TRACE(named.name + ", " + solver);
        const nscd::SolverResult result = ours(solver, named.problem, 1e-7);
        EXPECT_TRUE(result.converged) << result.residual;
        const std::vector<double> r = siconos::flat(result.impulses, 2);
        std::vector<double> velocities;
        EXPECT_LT(judge.error(r, &velocities), 1e-6);
        EXPECT_LT(relative_difference(velocities, u), 1e-5);
        for (std::size_t k = 0; k < unique.size(); ++k) {
            if (!unique[k]) continue;
            const double off = std::hypot(r[2 * k] - theirs.impulses[2 * k],
                                          r[2 * k + 1] - theirs.impulses[2 * k + 1]);
            EXPECT_LT(off, 1e-4 * norm(r)) << k;
            EXPECT_EQ(status(named.problem, r, k, 1e-4),
                      status(named.problem, theirs.impulses, k, 1e-4))
                << k;
        }
    }
};

// Each solution passes the other code's measure. The contact velocities agree, and so do impulses
// and statuses of all contacts whose impulse is determined by the velocities.
TEST(Triangles, AreSolvedAsBySiconosWithEverySolver) {
    StatusCount seen{};
    int sides = 0, hyperstatic = 0;
    for (const Named& named : problems_of_triangles()) {
        const Judgement judgement(named);
        ASSERT_TRUE(judgement.theirs.converged) << named.name;
        EXPECT_LT(nscd::natural_map_residual(named.problem,
                                             siconos::impulses_of(judgement.theirs.impulses, 2)),
                  1e-5)
            << named.name;
        for (const nscd::SolverEntry& entry : nscd::solvers_and_reference())
            judgement.compare(entry.name);
        for (std::size_t k = 0; k < judgement.unique.size(); ++k)
            if (judgement.unique[k])
                ++seen[status(named.problem, judgement.theirs.impulses, k, 1e-4)];
            else
                ++hyperstatic;
        sides += points_of_sides(named.problem);
        EXPECT_GT(coupling(named.problem), 0.3) << named.name;
    }
    for (const Status s : {open, sticking, sliding}) EXPECT_GT(seen[s], 5) << s;
    EXPECT_GT(sides, 20);
    EXPECT_GT(hyperstatic, 0);
}

}  // namespace
}  // namespace turbidite
