// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contact problem in dimensionless form, for solvers that factorise. With M^-1 = L L^T per
// body, v = v_free + L y, and impulses and contact velocities scaled so that every W_nn is one,
//
//     y = A r,      u = A^T y + q,      A^T A = W
//
// where A has one 3x3 block per contact and body. Spins and moments, the third components, are
// scaled by sqrt(W_nn/W_rr) so that they are comparable with velocities and impulses; they are zero
// without rolling resistance.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "granular_adapter/nscd/problem/contact_problem.hpp"

namespace turbidite::nscd {

class Delassus;

/// One contact: the rows n, t, roll of A^T for both bodies.
struct ScaledContact {
    std::int32_t a = -1, b = -1;  ///< -1: immovable
    Eigen::Matrix3d at_a = Eigen::Matrix3d::Zero(), at_b = Eigen::Matrix3d::Zero();
    Eigen::Vector3d free = Eigen::Vector3d::Zero();  ///< q
    double friction = 0.0, rolling = 0.0;            ///< bounds of |r_t| and |r_w| over r_n
    double impulse = 1.0;                            ///< scaled over physical normal impulse
    double length = 0.0;                             ///< sqrt(W_nn/W_rr), or zero [m]
};

class ScaledContacts {
 public:
    ScaledContacts(const ContactProblem& problem, const Delassus& w);

    std::size_t size() const { return contacts_.size(); }
    std::size_t bodies() const { return bodies_; }
    const ScaledContact& operator[](std::size_t k) const { return contacts_[k]; }

    /// (A^T y) of contact k, without q.
    Eigen::Vector3d velocity(std::size_t k, const Eigen::VectorXd& y) const;

    /// y += A r for contact k alone.
    void push(std::size_t k, const Eigen::Vector3d& r, Eigen::VectorXd& y) const;

    /// The impulse in the units of the problem, projected into the cone if outside.
    ContactVector physical(std::size_t k, const Eigen::Vector3d& r) const;

 private:
    std::vector<ScaledContact> contacts_;
    std::size_t bodies_ = 0;
};

}  // namespace turbidite::nscd
