// SPDX-License-Identifier: GPL-3.0-or-later
//
// Common to the tests against Siconos: our solvers by name, and vectors of (n, t) or (n, t, s) of
// all contacts.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "bench/siconos/siconos_problem.hpp"
#include "nlgs_stored.hpp"

namespace turbidite::judged {

struct Named {
    std::string name;
    nscd::ContactProblem problem;  ///< dimensionless
};

inline nscd::SolverResult ours(const std::string& solver, const nscd::ContactProblem& problem,
                               double tolerance) {
    nscd::SolverSettings settings;
    settings.tolerance = tolerance;
    settings.max_iterations = 300000;
    return nscd::make_solver(solver, nscd::solvers_and_reference())
        ->solve(problem, nscd::Impulses(problem.contacts.size()), settings);
}

inline double norm(const std::vector<double>& x) {
    double sum = 0.0;
    for (const double value : x) sum += value * value;
    return std::sqrt(sum);
}

inline std::vector<double> difference(std::vector<double> a, const std::vector<double>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
    return a;
}

/// |a - b| / |b|.
inline double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
    return norm(difference(a, b)) / norm(b);
}

enum Status { open, sticking, sliding };

/// Status by the impulse of contact k; less than `share` of the norm of all impulses counts as
/// zero.
inline Status status(const nscd::ContactProblem& problem, const std::vector<double>& r,
                     std::size_t k, double share = 1e-7) {
    const auto d = static_cast<std::size_t>(nscd::dimension(problem.bodies));
    const double zero = share * norm(r), n = r[d * k];
    const double t = norm({&r[d * k + 1], &r[d * k] + d});
    if (n < zero) return open;
    return t > problem.contacts[k].friction * n - zero ? sliding : sticking;
}

using StatusCount = std::array<int, 3>;

inline StatusCount statuses(const nscd::ContactProblem& problem, const std::vector<double>& r) {
    StatusCount count{};
    for (std::size_t k = 0; k < problem.contacts.size(); ++k) ++count[status(problem, r, k)];
    return count;
}

}  // namespace turbidite::judged
