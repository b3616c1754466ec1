// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contact problems of a collapsing column, in the plane or in space, and the solutions of both
// codes in each other's measure.
#pragma once

#include <gtest/gtest.h>

#include "bench/siconos/dry_column.hpp"
#include "granular_adapter/nscd/problem/residual.hpp"
#include "judged.hpp"

namespace turbidite::judged {

/// The problems at these times [t_c], dimensionless, appended to the list.
inline void take_problems(const std::string& name, nscd::Engine engine, double step,
                          const std::vector<double>& times, std::vector<Named>& list) {
    const siconos::Scale scale{engine.bodies().mass.front(), step};
    double now = 0.0;
    for (const double time : times) {
        bench::play(engine, time - now, step);
        now = time;
        list.push_back({name + ", t = " + std::to_string(time),
                        siconos::dimensionless(engine.problem(), scale)});
    }
}

/// At which the solvers stop: ours of our natural map, Siconos of its measure.
struct Tolerances {
    double ours = 1e-6, theirs = 1e-7;
};

inline void compare_with_siconos(const Named& named, const siconos::Problem& judge,
                                 const siconos::Solution& theirs, const std::string& solver,
                                 double tolerance) {
    SCOPED_TRACE(named.name + ", " + solver);
    const nscd::SolverResult result = ours(solver, named.problem, tolerance);
    EXPECT_TRUE(result.converged) << result.residual;
    std::vector<double> u_ours, u_theirs;
    EXPECT_LT(judge.error(siconos::flat(result.impulses, judge.dimension()), &u_ours), 1e-6);
    judge.error(theirs.impulses, &u_theirs);
    EXPECT_LT(relative_difference(u_ours, u_theirs), 1e-5);
}

/// Solves the problem with Siconos and with all our solvers of its dimension: each solution passes
/// the other code's measure, and the contact velocities agree. Returns Siconos' impulses.
inline std::vector<double> judge_each_other(const Named& named, const Tolerances& tolerances) {
    SCOPED_TRACE(named.name);
    const siconos::Problem judge(named.problem, {});
    const siconos::Solution theirs = judge.solve("nsgs", tolerances.theirs, 100000);
    EXPECT_TRUE(theirs.converged);
    EXPECT_LT(nscd::natural_map_residual(named.problem,
                                         siconos::impulses_of(theirs.impulses, judge.dimension())),
              1e-6);
    int solvers = 0;
    for (const nscd::SolverEntry& entry : nscd::solvers_and_reference()) {
        if (judge.dimension() == 3 && !entry.make()->solves_space()) continue;
        compare_with_siconos(named, judge, theirs, entry.name, tolerances.ours);
        ++solvers;
    }
    EXPECT_GT(solvers, 0);
    return theirs.impulses;
}

}  // namespace turbidite::judged
