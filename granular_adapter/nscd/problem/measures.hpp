// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The measures of residual.hpp for a caller that already has the operator W of a problem, of any
// kind of contact, and v = body_velocities(problem, r).
#pragma once

#include <algorithm>
#include <cmath>

#include "granular_adapter/nscd/problem/cell_sums.hpp"
#include "granular_adapter/nscd/problem/contact_kind.hpp"
#include "granular_adapter/nscd/problem/residual.hpp"

namespace turbidite::nscd {

inline ContactVector biased_velocity(const Contact& contact, const std::vector<Twist>& v) {
    return contact_velocity(contact, v) + contact.bias;
}

/// The natural map of contact k, whose biased velocity is u.
template <ContactOperator W>
MapTerms map_terms_of(const ContactProblem& problem, const W& w, const std::vector<Twist>& v,
                      const Impulses& r, std::size_t k, const ContactVector& u) {
    const Contact& contact = problem.contacts[k];
    if constexpr (requires { map_terms(contact, w.block(k), r[k], u, Turning{}); })
        if (!r.moments.empty())
            return map_terms(contact, w.block(k), r[k], u,
                             Turning{r.moments[k], relative_spin(contact, v) + contact.spin_bias});
    return map_terms(contact, w.block(k), r[k], u);
}

/// The natural map, summed over the contacts.
struct MapSums {
    double error = 0.0, size = 0.0;

    void add(const MapTerms& term) {
        error += term.error;
        size += term.size;
    }
    void add(const MapSums& cell) {
        error += cell.error;
        size += cell.size;
    }

    double residual(double floor) const {
        return error == 0.0 ? 0.0 : std::sqrt(error / (size + floor));
    }
};

/// Quad and max, summed over the contacts; in space without moments.
struct ChangeSums {
    double change = 0.0, largest = 0.0, scale = 0.0;

    template <class Block>
    void add(const Contact& contact, const Block& w, const ContactVector& old,
             const ContactVector& u) {
        const bool filmed = w.film && w.film->acts(u.n);
        if (old == ContactVector{} && u.n >= 0.0 && !filmed) return;
        const ContactVector next = solution(contact, w, u - product(w, old));
        const double du = squared(w, product(w, next - old));
        change += du;
        largest = std::max(largest, du);
        scale += squared(w, product(w, 0.5 * (next + old)));
    }

    void add(const ChangeSums& cell) {
        change += cell.change;
        largest = std::max(largest, cell.largest);
        scale += cell.scale;
    }

    ChangeMeasures measures(std::size_t contacts) const {
        if (change == 0.0) return {};
        return {std::sqrt(change / scale),
                std::sqrt(largest * static_cast<double>(contacts) / scale)};
    }
};

/// A single sum.
struct PlainSum {
    double value = 0.0;

    void add(const PlainSum& cell) { value += cell.value; }
};

template <ContactOperator W>
double rounding_floor(const ContactProblem& problem, const W& w) {
    const RoundingFloor floor(problem);
    return sum_over_contacts<PlainSum>(problem,
                                       [&](PlainSum& sum, std::size_t k) {
                                           sum.value +=
                                               floor.term(problem.contacts[k], w.block(k).nn);
                                       })
        .value;
}

/// `floor`: rounding_floor(problem, w).
template <ContactOperator W>
double natural_map_residual(const ContactProblem& problem, const W& w, const std::vector<Twist>& v,
                            const Impulses& r, double floor) {
    return sum_over_contacts<MapSums>(
               problem,
               [&](MapSums& map, std::size_t k) {
                   map.add(
                       map_terms_of(problem, w, v, r, k, biased_velocity(problem.contacts[k], v)));
               })
        .residual(floor);
}

/// Sums of a measurement.
struct MeasureSums {
    MapSums map;
    ChangeSums change;

    void add(const MeasureSums& cell) { map.add(cell.map), change.add(cell.change); }
};

template <ContactOperator W>
Measures measures(const ContactProblem& problem, const W& w, const std::vector<Twist>& v,
                  const Impulses& r, double floor) {
    const auto sums =
        sum_over_contacts<MeasureSums>(problem, [&](MeasureSums& cell, std::size_t k) {
            const Contact& contact = problem.contacts[k];
            const ContactVector u = biased_velocity(contact, v);
            cell.map.add(map_terms_of(problem, w, v, r, k, u));
            cell.change.add(contact, w.block(k), r[k], u);
        });
    return {sums.map.residual(floor), sums.change.measures(contacts_in_all(problem))};
}

}  // namespace turbidite::nscd
