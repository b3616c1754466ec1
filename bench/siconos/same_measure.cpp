// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/siconos/same_measure.hpp"

#include <algorithm>
#include <cmath>

#include "granular_adapter/nscd/problem/plane/one_contact.hpp"

namespace turbidite::siconos {

using nscd::Plane;

double error_measure(const nscd::ContactProblem& problem, const nscd::Impulses& impulses) {
    const std::vector<Twist> v = nscd::body_velocities(problem, impulses);
    double error = 0.0, size_q = 0.0, size_r = 0.0, size_u = 0.0;
    const auto squared = [](const Plane& x) { return x[0] * x[0] + x[1] * x[1]; };
    for (std::size_t k = 0; k < impulses.size(); ++k) {
        const nscd::Contact& contact = problem.contacts[k];
        const auto biased = [&](const nscd::ContactVector& u) {
            return Plane{u.n + contact.bias.n, u.t + contact.bias.t};
        };
        const Plane u = biased(nscd::contact_velocity(contact, v));
        const Plane r{impulses[k].n, impulses[k].t};
        error += squared(nscd::natural_map(r, u, contact.friction, 1.0));
        size_q += squared(biased(nscd::contact_velocity(contact, problem.free)));
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
