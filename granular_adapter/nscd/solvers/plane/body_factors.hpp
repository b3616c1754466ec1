// SPDX-License-Identifier: LGPL-2.1-or-later
//
// LU factors of J = 1 + A D A^T, D one 3x3 block per contact. J has three rows per body, however
// many contacts there are, and is unsymmetric where contacts slide.
//
// Elimination goes body by body with 3x3 blocks as pivots, in a minimum-degree order computed once:
// the contacts stay the same while D changes. There is no pivoting. The solution is refined where
// more digits are needed; if a trial shows that refinement would not converge, a sparse LU with
// partial pivoting takes over, which is twenty times as slow or more.
#pragma once

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <cstdint>
#include <vector>

#include "granular_adapter/nscd/solvers/plane/scaled_contacts.hpp"

namespace turbidite::nscd {

using ContactBlocks = std::vector<Eigen::Matrix3d>;

class BodyFactors {
 public:
    /// Keeps a reference to the contacts, which must outlive it.
    explicit BodyFactors(const ScaledContacts& contacts);

    /// False if the factorisation fails: D contains values that are not numbers, or J is singular.
    bool factorise(const ContactBlocks& d);

    /// J^-1 right, to the accuracy of the factors.
    Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

    /// Sign of det J: 1 or -1.
    int sign() const { return sign_; }

 private:
    using Block = Eigen::Matrix3d;

    void order_bodies();
    void find_fill();
    void find_updates();
    std::int32_t place(std::int32_t row, std::int32_t column) const;
    void assemble(const ContactBlocks& d);
    bool eliminate();
    Eigen::VectorXd substitute(const Eigen::VectorXd& right) const;
    Eigen::VectorXd product(const ContactBlocks& d, const Eigen::VectorXd& y) const;
    bool accurate(const ContactBlocks& d) const;
    bool factorise_pivoting(const ContactBlocks& d);

    const ScaledContacts& contacts_;
    std::vector<std::int32_t> position_;    ///< of a body in the elimination order
    std::vector<std::int32_t> first_;       ///< first entry of each column of L in `row_`
    std::vector<std::int32_t> row_;         ///< row positions, ascending within a column
    std::vector<std::int32_t> target_;      ///< blocks changed by each pivot, in order
    std::vector<std::int32_t> of_contact_;  ///< blocks bb, aa, ab, ba of each contact
    /// Inverse pivots; then the blocks of L, column by column; then those of U in the same order.
    std::vector<Block> blocks_;
    int sign_ = 1;
    bool pivoting_ = false, analysed_ = false;
    Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::AMDOrdering<int>> full_;
};

}  // namespace turbidite::nscd
