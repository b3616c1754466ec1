// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/residual.hpp"

#include <algorithm>

#include "granular_adapter/nscd/delassus.hpp"
#include "granular_adapter/nscd/rolling_contact.hpp"
#include "granular_adapter/nscd/vec3.hpp"

namespace turbidite::nscd {
namespace {

// Relative error of a contact velocity that counts as rounding. A sum over a dozen contacts loses a
// few hundred times 1e-16; ten times more than needed hides impulses of 1e-12 of the momentum.
constexpr double rounding = 1e-12;

double squared(const Plane& x) {
    return x[0] * x[0] + x[1] * x[1];
}

Vec3 biased_velocity(const Contact& contact, const std::vector<Twist>& v) {
    const Vec3 u = contact_velocity(contact, v);
    return {u[0] + contact.bias[0], u[1] + contact.bias[1], u[2]};
}

/// One contact's |natural map|^2 and |r|^2.
struct Terms {
    double error, size;
};

Terms rolling_terms(const Contact& contact, const Block& w, const Vec3& r, const Vec3& u) {
    const double length = rolling_length(w), moment = r[2] / length;
    const Vec3 f = rolling_natural_map(r, u, contact.friction, contact.rolling, 1.0 / w.nn, length);
    return {dot(f, f), r[0] * r[0] + r[1] * r[1] + moment * moment};
}

Terms terms(const Contact& contact, const Block& w, const Vec3& r, const Vec3& u) {
    if (w.rr > 0.0) return rolling_terms(contact, w, r, u);
    const Plane impulse{r[0], r[1]};
    return {squared(natural_map(impulse, {u[0], u[1]}, contact.friction, 1.0 / w.nn)),
            squared(impulse)};
}

/// W_kk r.
Vec3 times(const Block& w, const Vec3& r) {
    return {w.nn * r[0] + w.nt * r[1] + w.nr * r[2], w.nt * r[0] + w.tt * r[1] + w.tr * r[2],
            w.nr * r[0] + w.tr * r[1] + w.rr * r[2]};
}

/// |u|^2 with spins as velocities.
double squared(const Block& w, const Vec3& u) {
    const double rolling = w.rr > 0.0 ? u[2] * u[2] * (w.nn / w.rr) : 0.0;
    return u[0] * u[0] + u[1] * u[1] + rolling;
}

Vec3 solution(const Contact& contact, const Block& w, const Vec3& b) {
    return w.rr > 0.0 ? solve_rolling_contact(w, b, contact.friction, contact.rolling)
                      : without_rolling(w, b, contact.friction);
}

}  // namespace

double rounding_floor(const ContactProblem& problem) {
    return rounding_floor(problem, Delassus(problem));
}

double rounding_floor(const ContactProblem& problem, const Delassus& w) {
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
    return natural_map_residual(problem, w, body_velocities(problem, r), r,
                                rounding_floor(problem, w));
}

double natural_map_residual(const ContactProblem& problem, const Delassus& w,
                            const std::vector<Twist>& v, const Impulses& r, double floor) {
    double error = 0.0, size = 0.0;
    for (std::size_t k = 0; k < r.size(); ++k) {
        const Contact& contact = problem.contacts[k];
        const Terms term = terms(contact, w.block(k), r[k], biased_velocity(contact, v));
        error += term.error;
        size += term.size;
    }
    if (error == 0.0) return 0.0;
    return std::sqrt(error / (size + floor));
}

ChangeMeasures change_measures(const ContactProblem& problem, const Impulses& r) {
    return change_measures(problem, Delassus(problem), body_velocities(problem, r), r);
}

ChangeMeasures change_measures(const ContactProblem& problem, const Delassus& w,
                               const std::vector<Twist>& v, const Impulses& r) {
    double change = 0.0, largest = 0.0, scale = 0.0;
    for (std::size_t k = 0; k < r.size(); ++k) {
        const Contact& contact = problem.contacts[k];
        const Block& block = w.block(k);
        const Vec3& old = r[k];
        const Vec3 others = biased_velocity(contact, v) - times(block, old);
        const Vec3 next = solution(contact, block, others);
        const double du = squared(block, times(block, next - old));
        change += du;
        largest = std::max(largest, du);
        scale += squared(block, times(block, 0.5 * (next + old)));
    }
    if (change == 0.0) return {};
    return {std::sqrt(change / scale), std::sqrt(largest * double(r.size()) / scale)};
}

}  // namespace turbidite::nscd
