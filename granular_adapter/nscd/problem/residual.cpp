// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/residual.hpp"

#include <algorithm>
#include <cmath>

#include "granular_adapter/nscd/problem/measures.hpp"
#include "granular_adapter/nscd/problem/plane/delassus.hpp"
#include "granular_adapter/nscd/problem/space/sphere_operator.hpp"

namespace turbidite::nscd {
namespace {

// Relative error of a contact velocity that counts as rounding. A sum over a dozen contacts loses a
// few hundred times 1e-16. Ten times the necessary value would hide impulses of 1e-12 of the
// momentum.
constexpr double rounding = 1e-12;

/// use(operator of the problem), whatever its kind.
template <class Use>
auto with_operator(const ContactProblem& problem, const Use& use) {
    return std::visit([&](const auto& bodies) { return use(operator_of(problem, bodies)); },
                      problem.bodies);
}

/// |W_nn (r_n* - r_n)|, r_n* of the contact alone with u_n the velocity in the problem.
double violation(const Film* film, double nn, double rn, double un) {
    if (!film) return std::abs(std::min(un, nn * rn));
    return nn * std::abs(solve_film(*film, nn, un - nn * rn).impulse - rn);
}

/// The largest weight(contact) times its violation.
template <class Weight>
double largest_violation(const ContactProblem& problem, const Impulses& r,
                         const std::vector<Twist>& v, Weight weight) {
    return with_operator(problem, [&](const auto& w) {
        double largest = 0.0;
        for (std::size_t k = 0; k < r.size(); ++k) {
            const Contact& contact = problem.contacts[k];
            const double u = biased_velocity(contact, v).n;
            const double left = violation(film_of(problem, k), w.block(k).nn, r[k].n, u);
            largest = std::max(largest, weight(contact) * left);
        }
        return largest;
    });
}

}  // namespace

double rounding_floor(const ContactProblem& problem) {
    return with_operator(problem, [&](const auto& w) { return rounding_floor(problem, w); });
}

RoundingFloor::RoundingFloor(const ContactProblem& problem) : cancelled_(problem.cancelled) {
    speeds_.reserve(problem.free.size());
    for (const Twist& twist : problem.free) speeds_.push_back(norm(twist.velocity));
}

double RoundingFloor::term(const Contact& contact, double nn) const {
    // The speeds of which u_n is the difference. An impulse of `rounding` times their sum over W_nn
    // changes u_n by as little as rounding does.
    double speed = speeds_[static_cast<std::size_t>(contact.b)] + norm(contact.bias) + cancelled_;
    if (contact.a >= 0) speed += speeds_[static_cast<std::size_t>(contact.a)];
    const double impulse = rounding * speed / nn;
    return impulse * impulse;
}

double natural_map_residual(const ContactProblem& problem, const Impulses& r) {
    if (contacts_in_all(problem) == 0) return 0.0;
    return with_operator(problem, [&](const auto& w) {
        return natural_map_residual(problem, w, body_velocities(problem, r), r,
                                    rounding_floor(problem, w));
    });
}

double contact_violation(const ContactProblem& problem, const Impulses& r,
                         const std::vector<Twist>& v) {
    // max |min(u_n, W_nn r_n)|, with films |W_nn (r_n* - r_n)|
    return largest_violation(problem, r, v, [](const Contact&) { return 1.0; });
}

double largest_sinking(const ContactProblem& problem, const Impulses& r,
                       const std::vector<Twist>& v, const std::vector<double>& radius, double dt) {
    return largest_violation(problem, r, v, [&](const Contact& contact) {
        double smaller = radius[static_cast<std::size_t>(contact.b)];
        if (contact.a >= 0)
            smaller = std::min(smaller, radius[static_cast<std::size_t>(contact.a)]);
        return dt / smaller;
    });
}

Impulses carried_by_contacts(const ContactProblem& problem, const Impulses& r,
                             const std::vector<Twist>& v) {
    Impulses carried = r;
    with_operator(problem, [&](const auto& w) {
        for (std::size_t k = 0; k < r.size(); ++k) {
            const Contact& contact = problem.contacts[k];
            const auto& block = w.block(k);
            carried[k] = carried_part(contact, block, r[k], biased_velocity(contact, v));
            if constexpr (requires { held_moment(contact, block, 0.0, Turning{}); })
                if (!r.moments.empty() && block.rr > 0.0)
                    carried.moments[k] =
                        held_moment(contact, block, carried[k].n,
                                    {r.moments[k], relative_spin(contact, v) + contact.spin_bias});
        }
    });
    return carried;
}

ChangeMeasures change_measures(const ContactProblem& problem, const Impulses& r) {
    return with_operator(problem, [&](const auto& w) {
        return measures(problem, w, body_velocities(problem, r), r, 0.0).change;
    });
}

}  // namespace turbidite::nscd
