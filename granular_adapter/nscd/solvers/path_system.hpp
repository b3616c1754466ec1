// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Signorini-Coulomb as products of non-negative numbers that all have to vanish, and the smooth
// curves that lead there. With p, m >= 0 the parts of u_t = p - m, and likewise for rolling, a
// contact is solved when
//
//     r_n u_n = 0,     (mu r_n + r_t) p = 0,     (mu r_n - r_t) m = 0
//
// with all six factors >= 0: impulse sides a = G r, velocity sides b with E b = u. Points of the
// curves satisfy
//
//     a b = tau z,     E b = u(r) + z e,     E b = (b_n + s mu (p + m), p - m)
//
// where tau and e are such that a point known at z = 1 lies on them. They have two parameters:
//
//     z  1 -> 0   products vanish. At z = 0 the law is exact, whatever the rank of W: in between
//                 impulses are the most balanced ones, as in interior-point methods.
//     s  1 -> 0   association. At s = 1 sliding contacts dilate, u_n = mu |u_t|: E = G^T, the
//                 problem is convex, and the curve in z is the central path of a quadratic program
//                 (the dilation is the s of Acary and Cadoux 2011). At s = 0 the law is Coulomb's,
//                 not associated, and the problem is not monotone.
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
    double association = 1.0;  ///< s
};

/// A change of all of it.
using PathChange = PathPoint;

/// to += factor change.
void add(PathPoint& to, double factor, const PathChange& change);

/// What changes along the curve while the other one stays.
enum class PathParameter { products, association };

class PathSystem {
 public:
    /// The curve in z that starts, associated, from normal impulses of `size` times the mean free
    /// velocity. Keeps a reference: the contacts must live as long.
    PathSystem(const ScaledContacts& contacts, double size);

    const PathPoint& start() const { return start_; }

    /// tau z over the mean square of q: what factors are to each other.
    double product(const PathPoint& at) const { return tau_ * at.z / (unit_ * unit_); }

    void follow(PathParameter parameter) { parameter_ = parameter; }
    PathParameter parameter() const { return parameter_; }

    /// Prepares the three changes below; false when J has no factors.
    bool linearise(const PathPoint& at);

    /// Along the curve, per change of ln z or of s. These three are at the point of the last
    /// linearise().
    PathChange tangent() const;
    /// Onto the curve, z and s kept.
    PathChange correction() const;
    /// Second derivative along the curve where `velocity` is the first, z'' = s'' = 0.
    PathChange curvature(const PathChange& velocity) const;
    /// Sign of the determinant of the linear equations: changes where the curve turns back in its
    /// parameter.
    int sign() const { return factors_.sign(); }

    /// How far products are from tau z: 0 on the curve, 1 where one is 0 or infinite times too
    /// large. 1 where a factor is not positive, too.
    double deviation(const PathPoint& at) const;

    /// sum x y over the squares of what they change: changes count relatively, but that of s, which
    /// counts as it is. z and s count as much as one pair per contact each.
    double dot(const PathPoint& at, const PathChange& x, const PathChange& y) const;

    /// Largest relative decrease of a factor.
    double decrease(const PathPoint& at, const PathChange& change) const;

 private:
    using Vector3 = Eigen::Vector3d;

    /// Theta of one contact, an arrow: the tangent and rolling are coupled to the normal alone.
    struct Stiffness {
        Eigen::Matrix3d theta = Eigen::Matrix3d::Zero();
        /// Pivot of the normal direction once the other two are eliminated.
        double normal = 0.0;
    };

    bool has(std::size_t k, int pair) const { return (has_[k] >> pair & 1) != 0; }
    double limit(std::size_t k, int pair) const;
    Pairs impulse_sides(std::size_t k, const Vector3& r) const;
    double dilation(std::size_t k, const Pairs& b) const;
    Vector3 velocity_of(std::size_t k, const Pairs& b, double association) const;
    Vector3 defect(std::size_t k) const;
    Stiffness stiffness(std::size_t k) const;
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
    PathParameter parameter_ = PathParameter::products;
    PathPoint start_, at_;
    Eigen::VectorXd y_;                 ///< of at_
    std::vector<Stiffness> stiffness_;  ///< of at_
    ContactBlocks inverse_;             ///< of Theta
};

}  // namespace turbidite::nscd
