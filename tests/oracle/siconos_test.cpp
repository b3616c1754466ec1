// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contact problems of our packings and Siconos (INRIA), an independent code: it reads our files,
// evaluates our answers by its error measure, and solves the same problems; we evaluate its answers
// by ours. The impulses of packings are not unique, the velocities are.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "bench/siconos/same_measure.hpp"
#include "bench/siconos/siconos_problem.hpp"
#include "each_other.hpp"
#include "granular_adapter/nscd/problem/plane/delassus_matrix.hpp"
#include "nlgs_stored.hpp"
#include "problems.hpp"

namespace turbidite {
namespace {

using namespace judged;
using nscd::ContactProblem;
using nscd::problems::random_problem;

constexpr bench::DryColumn dense{.compacity = 0.9069, .width = 8.0, .height = 16.0};
constexpr bench::DryColumn loose{.compacity = 0.7854, .width = 8.0, .height = 16.0};

const std::vector<Named>& problems_of_columns() {
    static const std::vector<Named> list = [] {
        std::vector<Named> all;
        take_problems("dense", bench::dry_column(dense), dense.step, {2.0, 4.0}, all);
        take_problems("loose", bench::dry_column(loose), loose.step, {2.0, 4.0}, all);
        return all;
    }();
    return list;
}

TEST(SiconosReads, OurFilesBitForBit) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const ContactProblem problem = random_problem({.seed = seed});
        const siconos::Problem read(problem, {});
        const nscd::DelassusMatrix w(problem);
        const std::size_t n = w.size();
        ASSERT_EQ(read.contacts(), static_cast<int>(n));
        std::vector<double> expected(4 * n * n, 0.0);
        const auto put = [&](std::size_t k, std::size_t j, const std::array<double, 4>& block) {
            for (int i = 0; i < 4; ++i)
                expected[(2 * k + i % 2) + 2 * n * (2 * j + i / 2)] = block[i];
        };
        for (std::size_t k = 0; k < n; ++k) {
            const nscd::Block& d = w.diagonal[k];
            put(k, k, {d.nn, d.nt, d.nt, d.tt});
            for (std::int64_t e = w.row_start[k]; e < w.row_start[k + 1]; ++e) {
                const nscd::Coupling& c = w.coupling[e];
                put(k, w.column[e], {c.by_n[0], c.by_n[1], c.by_t[0], c.by_t[1]});
            }
        }
        EXPECT_EQ(read.dense_matrix(), expected);
        const std::vector<nscd::Plane> q = nscd::free_contact_velocities(problem);
        for (std::size_t k = 0; k < n; ++k) {
            EXPECT_EQ(read.q()[2 * k], q[k][0]);
            EXPECT_EQ(read.q()[2 * k + 1], q[k][1]);
            EXPECT_EQ(read.friction()[k], problem.contacts[k].friction);
        }
    }
}

// Our function of the same name agrees with theirs, at points that are not solutions.
TEST(SiconosMeasure, IsWhatWeTakeItFor) {
    for (const Named& named : problems_of_columns()) {
        nscd::Impulses r(named.problem.contacts.size());
        for (std::size_t k = 0; k < r.size(); ++k)
            r[k] = nscd::in_plane(std::sin(double(k)) + 0.5, 0.2 * std::cos(3.0 * double(k)));
        const double theirs = siconos::Problem(named.problem, {}).error(siconos::flat(r, 2));
        EXPECT_NEAR(siconos::error_measure(named.problem, r), theirs, 1e-12 * theirs);
        EXPECT_GT(theirs, 1e-3);
    }
}

// Each solution passes the other code's measure, and the contact velocities agree.
TEST(Columns, HaveTheVelocitiesOfSiconosWithEverySolver) {
    for (const Named& named : problems_of_columns()) judge_each_other(named, {});
}

// One contact per body, so that W is regular: impulses and statuses are unique.
TEST(Siconos, AgreesOnImpulsesAndStatusesWhereTheyAreUnique) {
    StatusCount seen{};
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const ContactProblem problem =
            random_problem({.bodies = 15, .extra_contacts = 0, .friction = 0.6, .seed = seed});
        const siconos::Problem judge(problem, {});
        const siconos::Solution theirs = judge.solve("nsgs", 1e-12, 300000);
        ASSERT_TRUE(theirs.converged) << seed;
        for (const nscd::SolverEntry& entry : nscd::solvers_and_reference()) {
            const nscd::SolverResult result = ours(entry.name, problem, 1e-12);
            const std::vector<double> r = siconos::flat(result.impulses, 2);
            EXPECT_LT(relative_difference(theirs.impulses, r), 1e-8) << seed << entry.name;
            EXPECT_EQ(statuses(problem, r), statuses(problem, theirs.impulses)) << seed;
            EXPECT_LT(judge.error(r), 1e-10);
        }
        for (int s = 0; s < 3; ++s) seen[s] += statuses(problem, theirs.impulses)[s];
    }
    for (const int count : seen) EXPECT_GT(count, 10);
}

}  // namespace
}  // namespace turbidite
