// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/siconos/same_measure.hpp"

#include <algorithm>
#include <cmath>

#include "granular_adapter/nscd/problem/space/one_contact.hpp"

namespace turbidite::siconos {

// The cone of space contains that of the plane: s = 0 there.
double error_measure(const nscd::ContactProblem& problem, const nscd::Impulses& impulses) {
    const std::vector<Twist> v = nscd::body_velocities(problem, impulses);
    double error = 0.0, size_q = 0.0, size_r = 0.0, size_u = 0.0;
    const auto squared = [](const nscd::ContactVector& x) {
        return x.n * x.n + x.t * x.t + x.s * x.s;
    };
    for (std::size_t k = 0; k < impulses.size(); ++k) {
        const nscd::Contact& contact = problem.contacts[k];
        const nscd::ContactVector& r = impulses[k];
        const nscd::ContactVector u = nscd::contact_velocity(contact, v) + contact.bias;
        error += squared(nscd::natural_map(r, u, contact.friction, 1.0));
        size_q += squared(nscd::contact_velocity(contact, problem.free) + contact.bias);
        size_r += squared(r);
        size_u += squared(u);
    }
    return std::sqrt(error / std::max({size_q, size_r, size_u}));
}

Stopped solve_to_measure(const nscd::ContactSolver& solver, const nscd::ContactProblem& problem,
                         double tolerance, std::int64_t most_iterations) {
    Stopped result;
    result.impulses.resize(problem.contacts.size());
    nscd::SolverSettings settings;
    settings.tolerance = 4.0 * tolerance;
    while (!result.converged && result.iterations < most_iterations) {
        settings.max_iterations = most_iterations - result.iterations;
        nscd::SolverResult solved = solver.solve(problem, result.impulses, settings);
        result.impulses = std::move(solved.impulses);
        result.iterations += solved.iterations;
        result.error = error_measure(problem, result.impulses);
        result.converged = result.error <= tolerance;
        // Both measures decrease together: aim slightly below the required error.
        settings.tolerance *= std::clamp(0.8 * tolerance / result.error, 0.2, 0.9);
    }
    return result;
}

}  // namespace turbidite::siconos
