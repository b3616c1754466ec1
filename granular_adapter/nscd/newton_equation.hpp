// SPDX-License-Identifier: LGPL-2.1-or-later
//
// J step = G of an AugmentedSystem. J is unsymmetric where contacts slide, and a sparse LU
// factorisation of it costs many times as much as a Cholesky factorisation of its symmetric part.
// So BiCGSTAB with the latter as preconditioner comes first, and LU where that does not converge.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <cstdint>
#include <vector>

#include "granular_adapter/nscd/augmented_system.hpp"

namespace turbidite::nscd {

class NewtonEquation {
 public:
    /// At the system's last residual, for the weight that it has. Throws std::runtime_error when no
    /// factorisation exists, which only numbers that are none can cause.
    Eigen::VectorXd solve(AugmentedSystem& system, double weight, const Eigen::VectorXd& g);

 private:
    void factorise(AugmentedSystem& system, double weight);

    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> symmetric_;
    Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::AMDOrdering<int>> full_;
    bool analysed_ = false, full_analysed_ = false, full_ready_ = false;
    Eigen::SparseMatrix<double> jacobian_;
    std::vector<std::uint8_t> statuses_;
    double weight_ = 0.0;
};

}  // namespace turbidite::nscd
