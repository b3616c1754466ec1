// SPDX-License-Identifier: LGPL-2.1-or-later
//
// LU factors of J = 1 + A D A^T, D one 3x3 block per contact: three unknowns per body however many
// contacts there are. J is unsymmetric where contacts slide.
//
// Elimination goes body by body, with 3x3 blocks as pivots, in an order of minimum degree that is
// found once: contacts stay the same while D changes. Nothing is exchanged for stability; whoever
// needs more digits refines, and where a trial shows that refinement would not converge, a sparse
// LU with partial pivoting, twenty times as slow or more, takes over.
#pragma once

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <cstdint>
#include <vector>

#include "granular_adapter/nscd/solvers/scaled_contacts.hpp"

namespace turbidite::nscd {

using ContactBlocks = std::vector<Eigen::Matrix3d>;

class BodyFactors {
 public:
    /// Keeps a reference: the contacts must live as long.
    explicit BodyFactors(const ScaledContacts& contacts);

    /// False when there are no factors: D holds numbers that are none, or J is singular.
    bool factorise(const ContactBlocks& d);

    /// J^-1 right, as exactly as the factors are.
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
    std::vector<std::int32_t> position_;    ///< of a body in the order of elimination
    std::vector<std::int32_t> first_;       ///< of the entries of a column of L in `row_`
    std::vector<std::int32_t> row_;         ///< positions, ascending
    std::vector<std::int32_t> target_;      ///< blocks that each pivot changes, in order
    std::vector<std::int32_t> of_contact_;  ///< blocks bb, aa, ab, ba of each contact
    /// Inverse pivots; then, entry by entry, L below them; then U beside them.
    std::vector<Block> blocks_;
    int sign_ = 1;
    bool pivoting_ = false, analysed_ = false;
    Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::AMDOrdering<int>> full_;
};

}  // namespace turbidite::nscd
