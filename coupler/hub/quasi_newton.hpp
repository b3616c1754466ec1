// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Interface quasi-Newton with inverse Jacobian from least squares (Degroote, Bathe, Vierendeels
// 2009): accelerates x <- H(x). With the residuals r_i = H(x_i) - x_i of the iterations so far, the
// coefficients that make |r_k + sum_i a_i (r_i - r_k)| smallest give
//
//     x_{k+1} = H(x_k) + sum_i a_i (H(x_i) - H(x_k))
//
// The first step is the fixed-point iteration itself.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace turbidite {

class QuasiNewton {
 public:
    /// x_{k+1} - x_k from r_k, the residual of the present iteration.
    Eigen::VectorXd step(const Eigen::VectorXd& residual);

 private:
    Eigen::VectorXd x_;                                // relative to the first
    std::vector<Eigen::VectorXd> residuals_, images_;  // r_i, H(x_i)
};

}  // namespace turbidite
