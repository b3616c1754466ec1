// SPDX-License-Identifier: GPL-3.0-or-later
//
// All solutions of a small contact problem by exhaustion: with each contact open, sticking, or
// sliding in either direction there are 4^n linear systems, and the solutions of the problem are
// those whose signs agree with the assumption.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "granular_adapter/nscd/problem/plane/delassus_matrix.hpp"
#include "nlgs_stored.hpp"
#include "problems.hpp"

namespace turbidite::judged {

/// u = W r + q over (n, t) of every contact.
struct SmallProblem {
    Eigen::MatrixXd w;
    Eigen::VectorXd q, friction;

    explicit SmallProblem(const nscd::ContactProblem& problem)
        : w(nscd::problems::dense_delassus(problem)), q(w.rows()), friction(w.rows() / 2) {
        const std::vector<nscd::Plane> free = nscd::free_contact_velocities(problem);
        for (Eigen::Index k = 0; k < friction.size(); ++k) {
            q.segment<2>(2 * k) << free[k][0], free[k][1];
            friction(k) = problem.contacts[k].friction;
        }
    }
};

/// 0 open, 1 sticking, 2 and 3 sliding with r_t = +mu r_n and -mu r_n.
using Guess = std::vector<int>;

inline Eigen::VectorXd impulses_of_guess(const SmallProblem& p, const Guess& guess) {
    Eigen::MatrixXd a = p.w;
    Eigen::VectorXd b = -p.q;
    for (std::size_t i = 0; i < guess.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        if (guess[i] == 1) continue;
        a.row(2 * k + 1).setZero(), b(2 * k + 1) = 0.0;
        a(2 * k + 1, 2 * k + 1) = 1.0;
        if (guess[i] >= 2) a(2 * k + 1, 2 * k) = guess[i] == 2 ? -p.friction(k) : p.friction(k);
        if (guess[i] == 0) a.row(2 * k).setZero(), a(2 * k, 2 * k) = 1.0, b(2 * k) = 0.0;
    }
    return a.partialPivLu().solve(b);
}

inline bool has_its_signs(const SmallProblem& p, const Guess& guess, const Eigen::VectorXd& r) {
    if (!r.allFinite()) return false;
    const Eigen::VectorXd u = p.w * r + p.q;
    const double zero_r = -1e-10 * r.norm(), zero_u = -1e-10 * p.q.norm();
    for (std::size_t i = 0; i < guess.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        const double n = r(2 * k), t = r(2 * k + 1), mu = p.friction(k);
        const bool fits = guess[i] == 0   ? u(2 * k) >= zero_u
                          : guess[i] == 1 ? mu * n - std::abs(t) >= zero_r
                          : guess[i] == 2 ? n >= zero_r && -u(2 * k + 1) >= zero_u
                                          : n >= zero_r && u(2 * k + 1) >= zero_u;
        if (!fits) return false;
    }
    return true;
}

/// Impulses (n, t) of every contact of all solutions.
inline std::vector<Eigen::VectorXd> all_solutions(const SmallProblem& p) {
    std::vector<Eigen::VectorXd> found;
    Guess guess(static_cast<std::size_t>(p.friction.size()), 0);
    for (std::uint64_t code = 0; code < 1ull << (2 * guess.size()); ++code) {
        for (std::size_t k = 0; k < guess.size(); ++k) guess[k] = code >> (2 * k) & 3;
        const Eigen::VectorXd r = impulses_of_guess(p, guess);
        if (!has_its_signs(p, guess, r)) continue;
        // On the boundary between two statuses a solution satisfies both.
        const auto same = [&](const Eigen::VectorXd& other) {
            return (other - r).norm() <= 1e-8 * r.norm();
        };
        if (std::none_of(found.begin(), found.end(), same)) found.push_back(r);
    }
    return found;
}

}  // namespace turbidite::judged
