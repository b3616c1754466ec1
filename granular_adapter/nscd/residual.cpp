// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/residual.hpp"

#include <algorithm>

#include "granular_adapter/nscd/delassus.hpp"
#include "granular_adapter/nscd/vec3.hpp"

namespace turbidite::nscd {
namespace {

// Relative error of a contact velocity that counts as rounding. A sum over a dozen contacts loses a
// few hundred times 1e-16; ten times more than needed hides impulses of 1e-12 of the momentum.
constexpr double rounding = 1e-12;

double squared(const Plane& x) {
    return x[0] * x[0] + x[1] * x[1];
}

Plane biased_velocity(const Contact& contact, const std::vector<Twist>& v) {
    const Vec3 u = contact_velocity(contact, v);
    return {u[0] + contact.bias[0], u[1] + contact.bias[1]};
}

Plane times(const Block& w, const Plane& r) {
    return {w.nn * r[0] + w.nt * r[1], w.nt * r[0] + w.tt * r[1]};
}

}  // namespace

double rounding_floor(const ContactProblem& problem) {
    const Delassus w(problem);
    double sum = 0.0;
    for (std::size_t k = 0; k < problem.contacts.size(); ++k) {
        const Contact& contact = problem.contacts[k];
        double speed =
            norm(problem.free[contact.b].velocity) + norm(contact.bias) + problem.cancelled;
        if (contact.a >= 0) speed += norm(problem.free[contact.a].velocity);
        const double impulse = rounding * speed / w.block(k).nn;
        sum += impulse * impulse;
    }
    return sum;
}

double natural_map_residual(const ContactProblem& problem, const Impulses& r) {
    if (r.empty()) return 0.0;
    const Delassus w(problem);
    const std::vector<Twist> v = body_velocities(problem, r);
    double error = 0.0, size = 0.0;
    for (std::size_t k = 0; k < r.size(); ++k) {
        const Contact& contact = problem.contacts[k];
        const Plane impulse{r[k][0], r[k][1]};
        error += squared(natural_map(impulse, biased_velocity(contact, v), contact.friction,
                                     1.0 / w.block(k).nn));
        size += squared(impulse);
    }
    if (error == 0.0) return 0.0;
    return std::sqrt(error / (size + rounding_floor(problem)));
}

ChangeMeasures change_measures(const ContactProblem& problem, const Impulses& r) {
    const Delassus w(problem);
    const std::vector<Twist> v = body_velocities(problem, r);
    double change = 0.0, largest = 0.0, scale = 0.0;
    for (std::size_t k = 0; k < r.size(); ++k) {
        const Contact& contact = problem.contacts[k];
        const Plane old{r[k][0], r[k][1]}, u = biased_velocity(contact, v);
        const Plane own = times(w.block(k), old);
        const Plane next =
            solve_contact(w.block(k), {u[0] - own[0], u[1] - own[1]}, contact.friction);
        const double du = squared(times(w.block(k), {next[0] - old[0], next[1] - old[1]}));
        change += du;
        largest = std::max(largest, du);
        scale += squared(times(w.block(k), {0.5 * (next[0] + old[0]), 0.5 * (next[1] + old[1])}));
    }
    if (change == 0.0) return {};
    return {std::sqrt(change / scale), std::sqrt(largest * double(r.size()) / scale)};
}

}  // namespace turbidite::nscd
