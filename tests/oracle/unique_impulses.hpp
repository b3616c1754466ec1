// SPDX-License-Identifier: GPL-3.0-or-later
//
// The impulses of a packing that are determined by the contact velocities.
//
// All solutions with the same u = W r + q differ by a d with W d = 0. If a contact separates, its
// impulse is zero in all of them; if it slides, r_t = -mu r_n sign(u_t), which leaves one unknown;
// otherwise there are two. Contacts at which every such d is zero have a unique impulse, however
// hyperstatic the rest is.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "bench/siconos/siconos_problem.hpp"

namespace turbidite::judged {

/// Directions in which impulses can vary at the velocities u, as columns over (n, t) of all
/// contacts. Speeds below `rest` count as zero.
inline Eigen::MatrixXd free_directions(const siconos::Problem& problem,
                                       const std::vector<double>& u, double rest) {
    const int n = problem.contacts();
    Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    int used = 0;
    for (int k = 0; k < n; ++k) {
        const double u_n = u[2 * k], u_t = u[2 * k + 1];
        if (u_n > rest) continue;
        directions(2 * k, used) = 1.0;
        if (std::abs(u_t) > rest)
            directions(2 * k + 1, used) = -std::copysign(problem.friction()[k], u_t);
        else
            directions(2 * k + 1, ++used) = 1.0;
        ++used;
    }
    return directions.leftCols(used);
}

/// By contact: whether its impulse is the same in all solutions with these velocities.
inline std::vector<bool> unique_impulses(const siconos::Problem& problem,
                                         const std::vector<double>& u, double rest) {
    const int n = problem.contacts();
    const std::vector<double> entries = problem.dense_matrix();
    const Eigen::Map<const Eigen::MatrixXd> w(entries.data(), 2 * n, 2 * n);
    const Eigen::MatrixXd directions = free_directions(problem, u, rest);
    std::vector<bool> unique(n, true);
    if (directions.cols() == 0) return unique;
    Eigen::FullPivLU<Eigen::MatrixXd> factors(w * directions);
    factors.setThreshold(1e-6);
    if (factors.dimensionOfKernel() == 0) return unique;
    const Eigen::MatrixXd wander = directions * factors.kernel();
    for (Eigen::Index i = 0; i < wander.cols(); ++i)
        for (int k = 0; k < n; ++k)
            if (wander.col(i).segment<2>(2 * k).norm() > 1e-6 * wander.col(i).norm())
                unique[k] = false;
    return unique;
}

}  // namespace turbidite::judged
