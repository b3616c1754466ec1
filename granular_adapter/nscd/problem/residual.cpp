// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/residual.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/problem/plane/delassus.hpp"
#include "granular_adapter/nscd/problem/plane/rolling_contact.hpp"

namespace turbidite::nscd {
namespace {

// Relative error of a contact velocity that counts as rounding. A sum over a dozen contacts loses a
// few hundred times 1e-16. Ten times the necessary value would hide impulses of 1e-12 of the
// momentum.
constexpr double rounding = 1e-12;

double squared(const Plane& x) {
    return x[0] * x[0] + x[1] * x[1];
}

ContactVector biased_velocity(const Contact& contact, const std::vector<Twist>& v) {
    return contact_velocity(contact, v) + contact.bias;
}

/// |natural map|^2 and |r|^2 of one contact.
struct Terms {
    double error, size;
};

Terms rolling_terms(const Contact& contact, const Block& w, const ContactVector& r,
                    const ContactVector& u) {
    const double length = rolling_length(w), moment = r.roll / length;
    const ContactVector f =
        rolling_natural_map(r, u, contact.friction, contact.rolling, 1.0 / w.nn, length);
    return {f.n * f.n + f.t * f.t + f.roll * f.roll, r.n * r.n + r.t * r.t + moment * moment};
}

Terms terms(const Contact& contact, const Block& w, const ContactVector& r,
            const ContactVector& u) {
    if (w.rr > 0.0) return rolling_terms(contact, w, r, u);
    const Plane impulse{r.n, r.t};
    return {squared(natural_map(impulse, {u.n, u.t}, contact.friction, 1.0 / w.nn)),
            squared(impulse)};
}

/// W_kk r.
ContactVector times(const Block& w, const ContactVector& r) {
    return in_plane(w.nn * r.n + w.nt * r.t + w.nr * r.roll,
                    w.nt * r.n + w.tt * r.t + w.tr * r.roll,
                    w.nr * r.n + w.tr * r.t + w.rr * r.roll);
}

/// |u|^2, with spins scaled to velocities.
double squared(const Block& w, const ContactVector& u) {
    const double rolling = w.rr > 0.0 ? u.roll * u.roll * (w.nn / w.rr) : 0.0;
    return u.n * u.n + u.t * u.t + rolling;
}

struct MapSums {
    double error = 0.0, size = 0.0;

    void add(const Contact& contact, const Block& w, const ContactVector& r,
             const ContactVector& u) {
        const Terms term = terms(contact, w, r, u);
        error += term.error;
        size += term.size;
    }

    double residual(double floor) const {
        return error == 0.0 ? 0.0 : std::sqrt(error / (size + floor));
    }
};

ContactVector solution(const Contact& contact, const Block& w, const ContactVector& b) {
    return w.rr > 0.0 ? solve_rolling_contact(w, b, contact.friction, contact.rolling)
                      : without_rolling(w, b, contact.friction);
}

struct ChangeSums {
    double change = 0.0, largest = 0.0, scale = 0.0;

    void add(const Contact& contact, const Block& w, const ContactVector& old,
             const ContactVector& u) {
        if (old == ContactVector{} && u.n >= 0.0) return;
        const ContactVector next = solution(contact, w, u - times(w, old));
        const double du = squared(w, times(w, next - old));
        change += du;
        largest = std::max(largest, du);
        scale += squared(w, times(w, 0.5 * (next + old)));
    }

    ChangeMeasures measures(std::size_t contacts) const {
        if (change == 0.0) return {};
        return {std::sqrt(change / scale),
                std::sqrt(largest * static_cast<double>(contacts) / scale)};
    }
};

}  // namespace

double rounding_floor(const ContactProblem& problem) {
    return rounding_floor(problem, Delassus(problem));
}

RoundingFloor::RoundingFloor(const ContactProblem& problem) : cancelled_(problem.cancelled) {
    speeds_.reserve(problem.free.size());
    for (const Twist& twist : problem.free) speeds_.push_back(norm(twist.velocity));
}

double RoundingFloor::term(const Contact& contact, const Block& w) const {
    double speed = speeds_[static_cast<std::size_t>(contact.b)] + norm(contact.bias) + cancelled_;
    if (contact.a >= 0) speed += speeds_[static_cast<std::size_t>(contact.a)];
    const double impulse = rounding * speed / w.nn;
    return impulse * impulse;
}

double rounding_floor(const ContactProblem& problem, const Delassus& w) {
    const RoundingFloor floor(problem);
    double sum = 0.0;
    for (std::size_t k = 0; k < problem.contacts.size(); ++k)
        sum += floor.term(problem.contacts[k], w.block(k));
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
    MapSums map;
    for (std::size_t k = 0; k < r.size(); ++k)
        map.add(problem.contacts[k], w.block(k), r[k], biased_velocity(problem.contacts[k], v));
    return map.residual(floor);
}

double contact_violation(const ContactProblem& problem, const Impulses& r,
                         const std::vector<Twist>& v) {
    const Delassus w(problem);
    double largest = 0.0;
    for (std::size_t k = 0; k < r.size(); ++k) {
        const double u = biased_velocity(problem.contacts[k], v).n;
        largest = std::max(largest, std::abs(std::min(u, w.block(k).nn * r[k].n)));
    }
    return largest;
}

ChangeMeasures change_measures(const ContactProblem& problem, const Impulses& r) {
    return measures(problem, Delassus(problem), body_velocities(problem, r), r, 0.0).change;
}

Measures measures(const ContactProblem& problem, const Delassus& w, const std::vector<Twist>& v,
                  const Impulses& r, double floor) {
    MapSums map;
    ChangeSums change;
    for (std::size_t k = 0; k < r.size(); ++k) {
        const Contact& contact = problem.contacts[k];
        const ContactVector u = biased_velocity(contact, v);
        map.add(contact, w.block(k), r[k], u);
        change.add(contact, w.block(k), r[k], u);
    }
    return {map.residual(floor), change.measures(r.size())};
}

}  // namespace turbidite::nscd
