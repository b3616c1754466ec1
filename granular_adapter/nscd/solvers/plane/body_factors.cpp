// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/solvers/plane/body_factors.hpp"

#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <algorithm>
#include <cmath>

namespace turbidite::nscd {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

// Relative error of a trial solution up to which refinement converges fast.
constexpr double refinable = 0.1;

Matrix body_graph(const ScaledContacts& contacts) {
    std::vector<Eigen::Triplet<double>> entries;
    const auto n = static_cast<std::int32_t>(contacts.bodies());
    for (std::int32_t i = 0; i < n; ++i) entries.emplace_back(i, i, 1.0);
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const ScaledContact& c = contacts[k];
        if (c.a < 0) continue;
        entries.emplace_back(c.a, c.b, 1.0);
        entries.emplace_back(c.b, c.a, 1.0);
    }
    Matrix graph(n, n);
    graph.setFromTriplets(entries.begin(), entries.end());
    return graph;
}

/// c -= a b.
void subtract_product(Eigen::Matrix3d& c, const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
    c.noalias() -= a.lazyProduct(b);
}

/// The blocks that contact c adds to A D A^T, as take(index, row, column, block) with bodies as
/// rows and columns: four, or one if only b can move.
template <class Take>
void each_block(const ScaledContact& c, const Eigen::Matrix3d& d, const Take& take) {
    using Block = Eigen::Matrix3d;
    // A = (at_b^T, -at_a^T): the impulse acts on a with the opposite sign.
    const Block by_b = d.lazyProduct(c.at_b);
    take(0, c.b, c.b, Block(c.at_b.transpose().lazyProduct(by_b)));
    if (c.a < 0) return;
    const Block by_a = d.lazyProduct(c.at_a);
    take(1, c.a, c.a, Block(c.at_a.transpose().lazyProduct(by_a)));
    take(2, c.a, c.b, Block(-c.at_a.transpose().lazyProduct(by_b)));
    take(3, c.b, c.a, Block(-c.at_b.transpose().lazyProduct(by_a)));
}

}  // namespace

BodyFactors::BodyFactors(const ScaledContacts& contacts) : contacts_(contacts) {
    order_bodies();
    find_fill();
    blocks_.resize(contacts.bodies() + 2 * row_.size());
    find_updates();
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const std::int32_t b = position_[contacts[k].b];
        const std::int32_t a = contacts[k].a < 0 ? b : position_[contacts[k].a];
        for (const std::int32_t at : {place(b, b), place(a, a), place(a, b), place(b, a)})
            of_contact_.push_back(at);
    }
}

void BodyFactors::order_bodies() {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(body_graph(contacts_), order);
    position_.resize(contacts_.bodies());
    for (std::size_t i = 0; i < position_.size(); ++i)
        position_[order.indices()[static_cast<Eigen::Index>(i)]] = static_cast<std::int32_t>(i);
}

/// Symbolic factorisation: the rows of each column of L are its own and those of the columns whose
/// first row it is.
void BodyFactors::find_fill() {
    const std::size_t n = contacts_.bodies();
    std::vector<std::vector<std::int32_t>> rows(n), children(n);
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
        if (contacts_[k].a < 0) continue;
        const auto [low, high] = std::minmax(position_[contacts_[k].a], position_[contacts_[k].b]);
        rows[low].push_back(high);
    }
    first_.assign(1, 0);
    for (std::size_t j = 0; j < n; ++j) {
        for (const std::int32_t child : children[j])
            // The first row of the child is j itself.
            rows[j].insert(rows[j].end(), rows[child].begin() + 1, rows[child].end());
        std::sort(rows[j].begin(), rows[j].end());
        rows[j].erase(std::unique(rows[j].begin(), rows[j].end()), rows[j].end());
        if (!rows[j].empty()) children[rows[j].front()].push_back(static_cast<std::int32_t>(j));
        row_.insert(row_.end(), rows[j].begin(), rows[j].end());
        first_.push_back(static_cast<std::int32_t>(row_.size()));
    }
}

void BodyFactors::find_updates() {
    for (std::size_t j = 0; j + 1 < first_.size(); ++j)
        for (std::int32_t e = first_[j]; e < first_[j + 1]; ++e)
            for (std::int32_t f = first_[j]; f < first_[j + 1]; ++f)
                // Block (e, f) for each pair of rows of the column: J has a symmetric pattern, so
                // that the columns of U are the rows of L. In the order in which eliminate() takes
                // them.
                target_.push_back(place(row_[e], row_[f]));
}

/// Index in `blocks_` of the block at two elimination positions.
std::int32_t BodyFactors::place(std::int32_t row, std::int32_t column) const {
    if (row == column) return row;
    const auto [low, high] = std::minmax(row, column);
    const auto begin = row_.begin() + first_[low], end = row_.begin() + first_[low + 1];
    const auto entry = static_cast<std::int32_t>(std::lower_bound(begin, end, high) - row_.begin());
    const auto bodies = static_cast<std::int32_t>(contacts_.bodies());
    return bodies + entry + (row > column ? 0 : static_cast<std::int32_t>(row_.size()));
}

void BodyFactors::assemble(const ContactBlocks& d) {
    const std::size_t n = contacts_.bodies();
    for (std::size_t i = 0; i < blocks_.size(); ++i)
        blocks_[i] = i < n ? Block(Block::Identity()) : Block(Block::Zero());
    for (std::size_t k = 0; k < contacts_.size(); ++k)
        each_block(contacts_[k], d[k], [&](int i, std::int32_t, std::int32_t, const Block& block) {
            blocks_[of_contact_[4 * k + i]] += block;
        });
}

bool BodyFactors::eliminate() {
    const std::size_t n = contacts_.bodies();
    Block* lower = blocks_.data() + n;
    const Block* upper = lower + row_.size();
    sign_ = 1;
    std::size_t update = 0;
    for (std::size_t j = 0; j < n; ++j) {
        const double determinant = blocks_[j].determinant();
        if (!(std::abs(determinant) > 0.0) || !std::isfinite(determinant)) return false;
        // det J is the product of the determinants of the pivots; the order of the bodies, the same
        // for rows and columns, does not change it.
        if (determinant < 0.0) sign_ = -sign_;
        const Block inverse = blocks_[j].inverse();
        blocks_[j] = inverse;
        for (std::int32_t e = first_[j]; e < first_[j + 1]; ++e) {
            // L_ej = J_ej J_jj^-1,   J_ef -= L_ej U_jf
            lower[e] = Block(lower[e].lazyProduct(inverse));
            for (std::int32_t f = first_[j]; f < first_[j + 1]; ++f)
                subtract_product(blocks_[target_[update++]], lower[e], upper[f]);
        }
    }
    return true;
}

Vector BodyFactors::substitute(const Vector& right) const {
    const std::size_t n = contacts_.bodies();
    const Block* lower = blocks_.data() + n;
    const Block* upper = lower + row_.size();
    Vector x(right.size());
    for (std::size_t i = 0; i < n; ++i)
        x.segment<3>(3 * position_[i]) = right.segment<3>(3 * static_cast<Eigen::Index>(i));
    for (std::size_t j = 0; j < n; ++j) {
        const Eigen::Vector3d pivot = x.segment<3>(3 * static_cast<Eigen::Index>(j));
        for (std::int32_t e = first_[j]; e < first_[j + 1]; ++e)
            // L x = right, in the order of elimination.
            x.segment<3>(3 * row_[e]) -= lower[e] * pivot;
    }
    for (std::size_t j = n; j-- > 0;) {
        Eigen::Vector3d pivot = x.segment<3>(3 * static_cast<Eigen::Index>(j));
        for (std::int32_t e = first_[j]; e < first_[j + 1]; ++e)
            // U x = L^-1 right, backwards.
            pivot -= upper[e] * x.segment<3>(3 * row_[e]);
        x.segment<3>(3 * static_cast<Eigen::Index>(j)) = blocks_[j] * pivot;
    }
    Vector result(right.size());
    for (std::size_t i = 0; i < n; ++i)
        result.segment<3>(3 * static_cast<Eigen::Index>(i)) = x.segment<3>(3 * position_[i]);
    return result;
}

Vector BodyFactors::product(const ContactBlocks& d, const Vector& y) const {
    Vector result = y;
    for (std::size_t k = 0; k < contacts_.size(); ++k)
        // J y = y + A D A^T y
        contacts_.push(k, d[k] * contacts_.velocity(k, y), result);
    return result;
}

/// Whether one refinement changes a trial solution only little.
bool BodyFactors::accurate(const ContactBlocks& d) const {
    Vector right = Vector::Zero(3 * static_cast<Eigen::Index>(contacts_.bodies()));
    for (std::size_t k = 0; k < contacts_.size(); ++k)
        // A D (1, 1, 0): of the kind of right-hand sides that a step has, and as badly scaled where
        // D is large.
        contacts_.push(k, d[k] * Eigen::Vector3d(1.0, 1.0, 0.0), right);
    const Vector trial = substitute(right);
    return substitute(right - product(d, trial)).norm() <= refinable * trial.norm();
}

bool BodyFactors::factorise_pivoting(const ContactBlocks& d) {
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](int, std::int32_t row, std::int32_t column, const Block& block) {
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                entries.emplace_back(3 * row + i, 3 * column + j, block(i, j));
    };
    const auto n = static_cast<std::int32_t>(contacts_.bodies());
    for (std::int32_t i = 0; i < n; ++i) add(0, i, i, Block::Identity());
    for (std::size_t k = 0; k < contacts_.size(); ++k) each_block(contacts_[k], d[k], add);
    Matrix j(3 * n, 3 * n);
    j.setFromTriplets(entries.begin(), entries.end());
    // The pattern is that of the contacts, which stay the same.
    if (!analysed_) full_.analyzePattern(j), analysed_ = true;
    full_.factorize(j);
    if (full_.info() != Eigen::Success) return false;
    sign_ = full_.signDeterminant() < 0.0 ? -1 : 1;
    return true;
}

bool BodyFactors::factorise(const ContactBlocks& d) {
    assemble(d);
    pivoting_ = false;
    if (eliminate() && accurate(d)) return true;
    pivoting_ = true;
    return factorise_pivoting(d);
}

Vector BodyFactors::solve(const Vector& right) const {
    return pivoting_ ? Vector(full_.solve(right)) : substitute(right);
}

}  // namespace turbidite::nscd
