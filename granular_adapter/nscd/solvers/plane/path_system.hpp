// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The equations of the interior-point method `central-path`: Signorini-Coulomb as products of
// non-negative factors that must all vanish, and the smooth curves that lead to such a point. With
// p, m >= 0 the parts of u_t = p - m, and likewise for rolling, a contact is solved when
//
//     r_n u_n = 0,     (mu r_n + r_t) p = 0,     (mu r_n - r_t) m = 0
//
// with all six factors >= 0: impulse factors a = G r, velocity factors b with E b = u. The points
// of the curves satisfy
//
//     a b = tau z,     E b = u(r) + z e,     E b = (b_n + s mu (p + m), p - m)
//
// where tau and e are chosen so that a known point lies on the curve at z = 1. There are two
// parameters:
//
//     z  1 -> 0   the products vanish. At z = 0 the law is exact, whatever the rank of W; before,
//                 impulses are as balanced as possible, as in interior-point methods generally.
//     s  1 -> 0   association. At s = 1 sliding contacts dilate, u_n = mu |u_t|: E = G^T, the
//                 problem is convex, and the curve in z is the central path of a quadratic program
//                 (the dilation is the s of Acary and Cadoux 2011). At s = 0 the law is Coulomb's,
//                 not associated, and the problem is not monotone.
//
// Newton's linear equations for a change of r, (Theta + A^T A) dr = ..., Theta = E diag(b/a) G, are
// solved in the bodies' unknowns (body_factors.hpp).
#pragma once

#include <array>
#include <vector>

#include "granular_adapter/nscd/solvers/plane/body_factors.hpp"

namespace turbidite::nscd {

/// The five factor pairs of a contact: normal, friction in both directions, rolling in both
/// directions.
using Pairs = std::array<double, 5>;

struct PathPoint {
    std::vector<Pairs> a, b;  ///< positive if the contact has the pair, else zero
    std::vector<Eigen::Vector3d> r;
    double z = 1.0;
    double association = 1.0;  ///< s
};

/// A change of all values of a point.
using PathChange = PathPoint;

/// to += factor * change.
void add(PathPoint& to, double factor, const PathChange& change);

/// The parameter that changes along the curve; the other one is constant.
enum class PathParameter { products, association };

class PathSystem {
 public:
    /// The curve in z that starts at an associated point (s = 1) with normal impulses of `size`
    /// times the mean free velocity. Keeps a reference to the contacts, which must outlive it.
    PathSystem(const ScaledContacts& contacts, double size);

    const PathPoint& start() const { return start_; }

    /// tau z over the mean square of q: the dimensionless product of a pair of factors.
    double product(const PathPoint& at) const { return tau_ * at.z / (unit_ * unit_); }

    void follow(PathParameter parameter) { parameter_ = parameter; }
    PathParameter parameter() const { return parameter_; }

    /// Prepares the three changes below; false if J cannot be factorised.
    bool linearise(const PathPoint& at);

    /// First derivative of the curve with respect to ln z or s, at the point of the last
    /// linearise(), as are the next two.
    PathChange tangent() const;
    /// Newton step onto the curve at constant z and s.
    PathChange correction() const;
    /// Second derivative along the curve if `velocity` is the first and z'' = s'' = 0.
    PathChange curvature(const PathChange& velocity) const;
    /// Sign of the determinant of the linear equations; it changes where the curve turns back in
    /// its parameter.
    int sign() const { return factors_.sign(); }

    /// Distance of the products from tau z: 0 on the curve, 1 if a product is zero or infinitely
    /// too large, or if a factor is not positive.
    double deviation(const PathPoint& at) const;

    /// Scalar product of two changes, each relative to the value it changes (s absolutely). z and s
    /// weigh as much as one pair per contact each.
    double dot(const PathPoint& at, const PathChange& x, const PathChange& y) const;

    /// Largest relative decrease of a factor.
    double decrease(const PathPoint& at, const PathChange& change) const;

 private:
    using Vector3 = Eigen::Vector3d;

    /// Theta of one contact. It is an arrow matrix: tangent and rolling couple to the normal only.
    struct Stiffness {
        Eigen::Matrix3d theta = Eigen::Matrix3d::Zero();
        /// Pivot of the normal direction after elimination of the other two.
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
    double unit_ = 0.0;            ///< unit of impulses and velocities: root mean square of q
    double tau_ = 0.0;
    PathParameter parameter_ = PathParameter::products;
    PathPoint start_, at_;
    Eigen::VectorXd y_;                 ///< at the point at_
    std::vector<Stiffness> stiffness_;  ///< at the point at_
    ContactBlocks inverse_;             ///< inverse blocks of Theta
};

}  // namespace turbidite::nscd
