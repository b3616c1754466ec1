// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Signorini-Coulomb as products of non-negative numbers that all have to vanish, and the smooth
// curve that leads there. With p, m >= 0 the parts of u_t = p - m, and likewise for rolling, a
// contact is solved when
//
//     r_n u_n = 0,     (mu r_n + r_t) p = 0,     (mu r_n - r_t) m = 0
//
// with all six factors >= 0: impulse sides a = G r, velocity sides b with E b = u. G and E^T differ
// in one column, which is what makes friction non-associated and the problem non-monotone. The
// curve asks for
//
//     a b = tau z,     E b = u(r) + z e
//
// where tau and e are such that a point known at z = 1 lies on it. At z = 0 it is the contact
// problem, exact, whatever the rank of W: in between impulses are the most balanced ones.
//
// Newton's linear equations for a change of r, (Theta + A^T A) dr = ..., Theta = E diag(b/a) G, are
// solved through the bodies (body_factors.hpp).
#pragma once

#include <array>
#include <vector>

#include "granular_adapter/nscd/solvers/body_factors.hpp"

namespace turbidite::nscd {

/// Normal, friction up and down, rolling both ways.
using Pairs = std::array<double, 5>;

struct PathPoint {
    std::vector<Pairs> a, b;  ///< above zero where the contact has the pair, else zero
    std::vector<Eigen::Vector3d> r;
    double z = 1.0;
};

/// A change of all of it.
using PathChange = PathPoint;

/// to += factor change.
void add(PathPoint& to, double factor, const PathChange& change);

class PathSystem {
 public:
    /// The curve that starts from normal impulses of `size` times the mean free velocity. Keeps a
    /// reference: the contacts must live as long.
    PathSystem(const ScaledContacts& contacts, double size);

    const PathPoint& start() const { return start_; }

    /// tau z over the mean square of q: what factors are to each other.
    double product(const PathPoint& at) const { return tau_ * at.z / (unit_ * unit_); }

    /// Prepares the three changes below; false when J has no factors.
    bool linearise(const PathPoint& at);

    /// Along the curve, per change of ln z. These three are at the point of the last linearise().
    PathChange tangent() const;
    /// Onto the curve, z kept.
    PathChange correction() const;
    /// Second derivative along the curve where `velocity` is the first, z'' = 0.
    PathChange curvature(const PathChange& velocity) const;
    /// Sign of the determinant of the linear equations: changes where the curve turns back in z.
    int sign() const { return factors_.sign(); }

    /// How far products are from tau z: 0 on the curve, 1 where one is 0 or infinite times too
    /// large. 1 where a factor is not positive, too.
    double deviation(const PathPoint& at) const;

    /// sum x y over the squares of what they change: changes count relatively. z counts as much as
    /// one pair per contact.
    double dot(const PathPoint& at, const PathChange& x, const PathChange& y) const;

    /// Largest relative decrease of a factor.
    double decrease(const PathPoint& at, const PathChange& change) const;

 private:
    using Vector3 = Eigen::Vector3d;

    bool has(std::size_t k, int pair) const { return (has_[k] >> pair & 1) != 0; }
    double limit(std::size_t k, int pair) const;
    Pairs impulse_sides(std::size_t k, const Vector3& r) const;
    Vector3 defect(std::size_t k) const;
    Eigen::Matrix3d stiffness(std::size_t k) const;
    Vector3 flexible(std::size_t k, const Vector3& right) const;
    std::vector<Vector3> solve(const std::vector<Vector3>& right) const;
    template <class Target, class Row>
    PathChange change(const Target& target, const Row& row) const;

    const ScaledContacts& contacts_;
    BodyFactors factors_;
    std::vector<unsigned char> has_;
    std::vector<Vector3> offset_;  ///< e
    double unit_ = 0.0;            ///< of impulses and velocities: root of the mean square of q
    double tau_ = 0.0;
    PathPoint start_, at_;
    Eigen::VectorXd y_;                   ///< of at_
    std::vector<Eigen::Matrix3d> theta_;  ///< of at_
    ContactBlocks inverse_;               ///< of theta_
};

}  // namespace turbidite::nscd
