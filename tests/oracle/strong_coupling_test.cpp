// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small problems with strong coupling of normal and tangent, mu up to 2. Neither existence nor
// uniqueness is guaranteed there, so all solutions are first found by exhaustion; if there is
// exactly one, Siconos and our solvers must find it.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "all_solutions.hpp"
#include "judged.hpp"

namespace turbidite {
namespace {

using namespace judged;
using nscd::ContactProblem;

/// Arms `scale` times as long as in packings; friction from 0 to 2.
ContactProblem strongly_coupled(unsigned seed, double scale) {
    ContactProblem problem = nscd::problems::random_problem(
        {.bodies = 6, .extra_contacts = 0, .friction = 2.0, .seed = seed});
    for (nscd::Contact& contact : problem.contacts)
        for (Vec3* arm : {&contact.arm_a, &contact.arm_b}) *arm = scale * *arm;
    return problem;
}

/// Largest |W_nt| / sqrt(W_nn W_tt); at 1, W becomes singular.
double coupling(const SmallProblem& p) {
    double largest = 0.0;
    for (Eigen::Index k = 0; k < p.friction.size(); ++k)
        largest = std::max(largest, std::abs(p.w(2 * k, 2 * k + 1)) /
                                        std::sqrt(p.w(2 * k, 2 * k) * p.w(2 * k + 1, 2 * k + 1)));
    return largest;
}

/// Counts over one hundred problems.
struct Tally {
    int unique = 0;      ///< with exactly one solution
    int by_siconos = 0;  ///< of these, those solved by NSGS
    std::map<std::string, int> by_us;
    double strongest = 0.0;
};

void judge(const ContactProblem& problem, const std::vector<double>& r, Tally& tally) {
    const siconos::Problem judge(problem, {});
    EXPECT_LT(judge.error(r), 1e-7);
    const siconos::Solution theirs = judge.solve("nsgs", 1e-9, 20000);
    if (theirs.converged) {
        ++tally.by_siconos;
        EXPECT_LT(relative_difference(theirs.impulses, r), 1e-6);
    }
    for (const nscd::SolverEntry& entry : nscd::solvers_and_reference()) {
        const nscd::SolverResult result = ours(entry.name, problem, 1e-11);
        if (!result.converged) continue;
        ++tally.by_us[entry.name];
        EXPECT_LT(relative_difference(siconos::flat(result.impulses, 2), r), 1e-8) << entry.name;
    }
}

Tally judge_hundred(double scale) {
    Tally tally;
    for (unsigned seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE(seed);
        const ContactProblem problem = strongly_coupled(seed, scale);
        const SmallProblem small(problem);
        tally.strongest = std::max(tally.strongest, coupling(small));
        const std::vector<Eigen::VectorXd> all = all_solutions(small);
        if (all.size() != 1) continue;
        ++tally.unique;
        judge(problem, {all[0].begin(), all[0].end()}, tally);
    }
    return tally;
}

TEST(StrongCoupling, EverySolverFindsTheOnlySolution) {
    for (const double scale : {1.0, 3.0}) {
        const Tally tally = judge_hundred(scale);
        EXPECT_EQ(tally.unique, 100);
        EXPECT_EQ(tally.by_siconos, 100);
        for (const nscd::SolverEntry& entry : nscd::solvers_and_reference())
            EXPECT_EQ(tally.by_us.at(entry.name), 100) << entry.name;
        EXPECT_GT(tally.strongest, scale == 1.0 ? 0.45 : 0.6);
    }
}

// Gauss-Seidel need not converge here, in either code: sweeps may cycle, and the solver then
// reports that it has not converged. Path following finds every solution.
TEST(StrongCoupling, SweepsThatConvergedAreRightAndPathsFindAll) {
    const Tally tally = judge_hundred(10.0);
    EXPECT_GT(tally.strongest, 0.95);
    EXPECT_GE(tally.unique, 90);
    EXPECT_EQ(tally.by_us.at("central-path"), tally.unique);
    for (const char* sweeps : {"nlgs", "nlgs-stored"})
        EXPECT_GE(tally.by_us.at(sweeps), tally.by_siconos) << sweeps;
}

}  // namespace
}  // namespace turbidite
