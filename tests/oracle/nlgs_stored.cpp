// SPDX-License-Identifier: LGPL-2.1-or-later
#include "nlgs_stored.hpp"

#include <stdexcept>

#include "granular_adapter/nscd/problem/plane/delassus_matrix.hpp"
#include "granular_adapter/nscd/solvers/check_schedule.hpp"

namespace turbidite::nscd {
namespace {

struct Sweeper {
    const DelassusMatrix w;
    const std::vector<Plane> free;
    std::vector<double> friction;
    std::vector<Plane> r;
    double error = 0.0, size = 0.0;  ///< sum |natural map|^2 and sum |r|^2 of a measuring sweep

    Sweeper(const ContactProblem& problem, const Impulses& guess)
        : w(problem), free(free_contact_velocities(problem)) {
        for (const Contact& contact : problem.contacts) friction.push_back(contact.friction);
        for (const ContactVector& impulse : guess) r.push_back({impulse.n, impulse.t});
    }

    /// b = u_free,k + sum_{j != k} W_kj r_j: the velocity of contact k without its own impulse.
    Plane others(std::size_t k) const {
        double n = free[k][0], t = free[k][1];
        const std::int64_t end = w.row_start[k + 1];
        for (std::int64_t e = w.row_start[k]; e < end; ++e) {
            const Coupling& c = w.coupling[e];
            const Plane& rj = r[w.column[e]];
            n += c.by_n[0] * rj[0] + c.by_t[0] * rj[1];
            t += c.by_n[1] * rj[0] + c.by_t[1] * rj[1];
        }
        return {n, t};
    }

    void measure(std::size_t k, const Plane& b) {
        const Block& own = w.diagonal[k];
        const Plane u = {b[0] + own.nn * r[k][0] + own.nt * r[k][1],
                         b[1] + own.nt * r[k][0] + own.tt * r[k][1]};
        const Plane f = natural_map(r[k], u, friction[k], 1.0 / own.nn);
        error += f[0] * f[0] + f[1] * f[1];
        size += r[k][0] * r[k][0] + r[k][1] * r[k][1];
    }

    template <bool measured>
    void sweep() {
        error = size = 0.0;
        for (std::size_t k = 0; k < r.size(); ++k) {
            const Plane b = others(k);
            if constexpr (measured) measure(k, b);
            r[k] = solve_contact(w.diagonal[k], b, friction[k]);
        }
    }

    void unpack(Impulses& impulses) const {
        for (std::size_t k = 0; k < r.size(); ++k) impulses[k] = in_plane(r[k][0], r[k][1]);
    }
};

void refuse_rolling(const ContactProblem& problem) {
    if (std::any_of(problem.contacts.begin(), problem.contacts.end(),
                    [](const Contact& contact) { return contact.rolling > 0.0; }))
        throw std::invalid_argument(
            "contact solver nlgs-stored does not support rolling resistance, which the contact law "
            "requires: use nlgs or central-path");
}

}  // namespace

std::vector<Plane> free_contact_velocities(const ContactProblem& problem) {
    std::vector<Plane> u;
    u.reserve(problem.contacts.size());
    for (const Contact& contact : problem.contacts) {
        const ContactVector free = contact_velocity(contact, problem.free) + contact.bias;
        u.push_back({free.n, free.t});
    }
    return u;
}

SolverResult NlgsStored::solve(const ContactProblem& problem, const Impulses& guess,
                               const SolverSettings& settings) const {
    check_settings(settings);
    refuse_rolling(problem);
    if (problem.contacts.empty()) return {{}, problem.free, 0, 0.0, {}, true};
    Sweeper sweeper(problem, guess);
    const double floor = rounding_floor(problem);
    const double target = settings.tolerance * settings.tolerance;
    SolverResult result;
    result.impulses = guess;
    result.converged = false;
    while (!result.converged && result.iterations < settings.max_iterations) {
        if (!check_due(++result.iterations, settings)) {
            sweeper.sweep<false>();
            continue;
        }
        sweeper.sweep<true>();
        const bool last = result.iterations == settings.max_iterations;
        if (!last && !(sweeper.error <= target * (sweeper.size + floor))) continue;
        sweeper.unpack(result.impulses);
        result.residual = natural_map_residual(problem, result.impulses);
        result.converged = result.residual <= settings.tolerance;
    }
    result.change = change_measures(problem, result.impulses);
    result.velocities = body_velocities(problem, result.impulses);
    return result;
}

const std::vector<SolverEntry>& solvers_and_reference() {
    static const std::vector<SolverEntry> solvers = [] {
        std::vector<SolverEntry> all(solver_list().begin(), solver_list().end());
        all.push_back({"nlgs-stored", "Gauss-Seidel on the assembled Delassus operator",
                       []() -> std::unique_ptr<const ContactSolver> {
                           return std::make_unique<NlgsStored>();
                       }});
        return all;
    }();
    return solvers;
}

}  // namespace turbidite::nscd
