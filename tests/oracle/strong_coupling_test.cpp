// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small problems in which normal and tangent are strongly coupled, mu up to 2. Neither existence
// nor uniqueness is a theorem there, so all solutions are found by exhaustion first; where there is
// one, Siconos and we must find it.
#include <gtest/gtest.h>

#include <algorithm>

#include "all_solutions.hpp"
#include "judged.hpp"

namespace turbidite {
namespace {

using namespace judged;
using nscd::ContactProblem;
using nscd::operator*;

/// Arms `scale` times as long as packings have them; friction from 0 to 2.
ContactProblem strongly_coupled(unsigned seed, double scale) {
    ContactProblem problem = nscd::problems::random_problem(
        {.bodies = 6, .extra_contacts = 0, .friction = 2.0, .seed = seed});
    for (nscd::Contact& contact : problem.contacts)
        for (Vec3* arm : {&contact.arm_a, &contact.arm_b}) *arm = scale * *arm;
    return problem;
}

/// Largest |W_nt| / sqrt(W_nn W_tt); 1 is where W ends to be regular.
double coupling(const SmallProblem& p) {
    double largest = 0.0;
    for (Eigen::Index k = 0; k < p.friction.size(); ++k)
        largest = std::max(largest, std::abs(p.w(2 * k, 2 * k + 1)) /
                                        std::sqrt(p.w(2 * k, 2 * k) * p.w(2 * k + 1, 2 * k + 1)));
    return largest;
}

class StrongCoupling : public testing::TestWithParam<double> {};

TEST_P(StrongCoupling, TheOnlySolutionIsFound) {
    int unique = 0, by_siconos = 0;
    double strongest = 0.0;
    for (unsigned seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE(seed);
        const ContactProblem problem = strongly_coupled(seed, GetParam());
        const SmallProblem small(problem);
        strongest = std::max(strongest, coupling(small));
        const std::vector<Eigen::VectorXd> all = all_solutions(small);
        if (all.size() != 1) continue;
        ++unique;
        const std::vector<double> r(all[0].begin(), all[0].end());
        const siconos::Problem judge(problem, {});
        EXPECT_LT(judge.error(r), 1e-7);
        const siconos::Solution theirs = judge.solve("nsgs", 1e-9, 20000);
        if (theirs.converged && ++by_siconos)
            EXPECT_LT(relative_difference(theirs.impulses, r), 1e-6);
        for (const nscd::SolverEntry& entry : nscd::solver_list()) {
            const nscd::SolverResult result = ours(entry.name, problem, 1e-11);
            EXPECT_TRUE(result.converged) << entry.name << ": " << result.residual;
            EXPECT_LT(relative_difference(siconos::flat(result.impulses, {}), r), 1e-8)
                << entry.name;
        }
    }
    std::fprintf(stderr, "unique %d siconos %d strongest %g\n", unique, by_siconos, strongest);
    EXPECT_GE(unique, 90);
    EXPECT_GE(by_siconos, 90);
    EXPECT_GT(strongest, 0.8);
}

INSTANTIATE_TEST_SUITE_P(Arms, StrongCoupling, testing::Values(1.0, 3.0, 10.0));

}  // namespace
}  // namespace turbidite
