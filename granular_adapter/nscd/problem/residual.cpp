// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/residual.hpp"

#include <algorithm>

#include "granular_adapter/nscd/plane/rolling_contact.hpp"
#include "granular_adapter/nscd/problem/delassus.hpp"
#include "granular_adapter/nscd/problem/vec3.hpp"

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

struct MapSums {
    double error = 0.0, size = 0.0;

    void add(const Contact& contact, const Block& w, const Vec3& r, const Vec3& u) {
        const Terms term = terms(contact, w, r, u);
        error += term.error;
        size += term.size;
    }

    double residual(double floor) const {
        return error == 0.0 ? 0.0 : std::sqrt(error / (size + floor));
    }
};

Vec3 solution(const Contact& contact, const Block& w, const Vec3& b) {
    return w.rr > 0.0 ? solve_rolling_contact(w, b, contact.friction, contact.rolling)
                      : without_rolling(w, b, contact.friction);
}

struct ChangeSums {
    double change = 0.0, largest = 0.0, scale = 0.0;

    void add(const Contact& contact, const Block& w, const Vec3& old, const Vec3& u) {
        if (old == Vec3{} && u[0] >= 0.0) return;
        const Vec3 next = solution(contact, w, u - times(w, old));
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

double rounding_floor(const ContactProblem& problem, const Delassus& w) {
    std::vector<double> speeds;
    speeds.reserve(problem.free.size());
    for (const Twist& twist : problem.free) speeds.push_back(norm(twist.velocity));
    double sum = 0.0;
    for (std::size_t k = 0; k < problem.contacts.size(); ++k) {
        const Contact& contact = problem.contacts[k];
        double speed =
            speeds[static_cast<std::size_t>(contact.b)] + norm(contact.bias) + problem.cancelled;
        if (contact.a >= 0) speed += speeds[static_cast<std::size_t>(contact.a)];
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
    MapSums map;
    for (std::size_t k = 0; k < r.size(); ++k)
        map.add(problem.contacts[k], w.block(k), r[k], biased_velocity(problem.contacts[k], v));
    return map.residual(floor);
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
        const Vec3 u = biased_velocity(contact, v);
        map.add(contact, w.block(k), r[k], u);
        change.add(contact, w.block(k), r[k], u);
    }
    return {map.residual(floor), change.measures(r.size())};
}

}  // namespace turbidite::nscd
