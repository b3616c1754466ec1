// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/solvers/plane/path_system.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite::nscd {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector = Eigen::VectorXd;

// A proximal term, in units of W_nn: Theta + firmness 1 replaces Theta. Contacts that neither open
// nor slide have Theta -> 0, and where 1/Theta exceeds 1/firmness the free motions would be lost in
// the rounding of the constrained ones. The term vanishes at the solution, where the impulses no
// longer change.
constexpr double firmness = 1e-7;

constexpr int most_refinements = 10;
constexpr double refined = 1e-11;  ///< relative change at which refinement stops
constexpr double halting = 0.9;    ///< reduction per refinement that is not worth another one

/// A r.
Vector bodies_of(const ScaledContacts& contacts, const std::vector<Vector3d>& r) {
    Vector y = Vector::Zero(3 * static_cast<Eigen::Index>(contacts.bodies()));
    for (std::size_t k = 0; k < r.size(); ++k) contacts.push(k, r[k], y);
    return y;
}

double squared(const std::vector<Vector3d>& x) {
    double sum = 0.0;
    for (const Vector3d& v : x) sum += v.squaredNorm();
    return sum;
}

}  // namespace

void add(PathPoint& to, double factor, const PathChange& change) {
    for (std::size_t k = 0; k < to.r.size(); ++k) {
        to.r[k] += factor * change.r[k];
        for (int i = 0; i < 5; ++i) {
            to.a[k][i] += factor * change.a[k][i];
            to.b[k][i] += factor * change.b[k][i];
        }
    }
    to.z += factor * change.z;
    to.association += factor * change.association;
}

PathSystem::PathSystem(const ScaledContacts& contacts, double size)
    : contacts_(contacts), factors_(contacts) {
    const std::size_t n = contacts.size();
    for (std::size_t k = 0; k < n; ++k) {
        unit_ += contacts[k].free.head<2>().squaredNorm();
        // One bit per pair: 1 normal, 2 and 4 friction, 8 and 16 rolling.
        has_.push_back((contacts[k].friction > 0.0 ? 7 : 1) | (contacts[k].rolling > 0.0 ? 24 : 0));
    }
    unit_ = std::sqrt(unit_ / static_cast<double>(n));
    const double r = size * unit_;
    // The start: r = (r_n, 0, 0) with the same r_n everywhere, b = tau/a, and e = E b - u(r), so
    // that it lies on the curve at z = 1.
    tau_ = r * r;
    start_.r.assign(n, Vector3(r, 0.0, 0.0));
    start_.a.assign(n, {}), start_.b.assign(n, {});
    const Vector y = bodies_of(contacts, start_.r);
    for (std::size_t k = 0; k < n; ++k) {
        start_.a[k] = impulse_sides(k, start_.r[k]);
        for (int i = 0; i < 5; ++i)
            if (has(k, i)) start_.b[k][i] = tau_ / start_.a[k][i];
        const Vector3 u = contacts.velocity(k, y) + contacts[k].free;
        Vector3 e = velocity_of(k, start_.b[k], start_.association) - u;
        if (!has(k, 1)) e[1] = 0.0;
        if (!has(k, 3)) e[2] = 0.0;
        offset_.push_back(e);
    }
    stiffness_.resize(n), inverse_.resize(n);
}

double PathSystem::limit(std::size_t k, int pair) const {
    return pair < 3 ? contacts_[k].friction : contacts_[k].rolling;
}

/// G r.
Pairs PathSystem::impulse_sides(std::size_t k, const Vector3& r) const {
    Pairs a{};
    a[0] = r[0];
    if (has(k, 1)) a[1] = limit(k, 1) * r[0] + r[1], a[2] = limit(k, 1) * r[0] - r[1];
    if (has(k, 3)) a[3] = limit(k, 3) * r[0] + r[2], a[4] = limit(k, 3) * r[0] - r[2];
    return a;
}

/// Opening velocity added by dilation at s = 1: mu (p + m), and the same for rolling.
double PathSystem::dilation(std::size_t k, const Pairs& b) const {
    return limit(k, 1) * (b[1] + b[2]) + limit(k, 3) * (b[3] + b[4]);
}

/// E b.
PathSystem::Vector3 PathSystem::velocity_of(std::size_t k, const Pairs& b,
                                            double association) const {
    return {b[0] + association * dilation(k, b), b[1] - b[2], b[3] - b[4]};
}

/// u + z e - E b; zero in directions without resistance.
PathSystem::Vector3 PathSystem::defect(std::size_t k) const {
    Vector3 d = contacts_.velocity(k, y_) + contacts_[k].free + at_.z * offset_[k] -
                velocity_of(k, at_.b[k], at_.association);
    if (!has(k, 1)) d[1] = 0.0;
    if (!has(k, 3)) d[2] = 0.0;
    return d;
}

/// Theta + firmness. With l = mu or the rolling bound, and p = b/a and m = b/a of the first and
/// second factors of a pair of directions:
///
///     Theta_nn = b_n/a_n + sum s l^2 (p + m)      Theta_nd = s l (p - m)
///     Theta_dn = l (p - m)                        Theta_dd = p + m
///
/// Rows of directions without resistance are zero. The pivot is written without the difference (p +
/// m) - (p - m)^2 / (p + m), which would cancel where a contact slides.
PathSystem::Stiffness PathSystem::stiffness(std::size_t k) const {
    const Pairs &a = at_.a[k], &b = at_.b[k];
    Stiffness result;
    Matrix3d& theta = result.theta;
    theta(0, 0) = result.normal = b[0] / a[0] + firmness;
    for (int d = 1; d < 3; ++d) {
        const int up = 2 * d - 1, down = 2 * d;
        if (!has(k, up)) continue;
        const double l = limit(k, up), p = b[up] / a[up], m = b[down] / a[down];
        const double dilating = at_.association * l * l;
        theta(d, 0) = l * (p - m);
        theta(0, d) = at_.association * theta(d, 0);
        theta(d, d) = p + m + firmness;
        theta(0, 0) += dilating * (p + m);
        result.normal += dilating * (4.0 * p * m + firmness * (p + m)) / theta(d, d);
    }
    return result;
}

/// Theta^-1 right; zero in directions without resistance.
PathSystem::Vector3 PathSystem::flexible(std::size_t k, const Vector3& right) const {
    const Matrix3d& theta = stiffness_[k].theta;
    Vector3 x(right[0], 0.0, 0.0);
    for (int d = 1; d < 3; ++d)
        if (theta(d, d) > 0.0) x[0] -= theta(0, d) / theta(d, d) * right[d];
    x[0] /= stiffness_[k].normal;
    for (int d = 1; d < 3; ++d)
        if (theta(d, d) > 0.0) x[d] = (right[d] - theta(d, 0) * x[0]) / theta(d, d);
    return x;
}

bool PathSystem::linearise(const PathPoint& at) {
    at_ = at;
    y_ = bodies_of(contacts_, at.r);
    for (std::size_t k = 0; k < at.r.size(); ++k) {
        stiffness_[k] = stiffness(k);
        // D = Theta^-1 of J = 1 + A D A^T, column by column.
        for (int d = 0; d < 3; ++d) inverse_[k].col(d) = flexible(k, Vector3::Unit(d));
    }
    return factors_.factorise(inverse_);
}

/// Solves Theta dr + A^T dy = right, dy = A dr. Both are refined, so that persistent contacts,
/// whose impulses are velocities times 1/Theta, lose no digits.
std::vector<Vector3d> PathSystem::solve(const std::vector<Vector3>& right) const {
    const std::size_t n = right.size();
    std::vector<Vector3> r(n, Vector3::Zero()), rest = right, step(n);
    Vector y = Vector::Zero(y_.size()), unbalanced = y;
    double last = 0.0;
    for (int i = 0; i <= most_refinements; ++i) {
        // With rest = right - Theta r - A^T y and unbalanced = A r - y, both zero at the solution:
        //     J dy = A Theta^-1 rest + unbalanced,   dr = Theta^-1 (rest - A^T dy)
        for (std::size_t k = 0; k < n; ++k) contacts_.push(k, flexible(k, rest[k]), unbalanced);
        const Vector moved = factors_.solve(unbalanced);
        for (std::size_t k = 0; k < n; ++k)
            step[k] = flexible(k, rest[k] - contacts_.velocity(k, moved));
        if (i > 0) {
            const double change = moved.norm() / y.norm() + std::sqrt(squared(step) / squared(r));
            // Rounding: another refinement would make it no better.
            if (!(i == 1 || change < halting * last)) break;
            last = change;
        }
        y += moved;
        for (std::size_t k = 0; k < n; ++k) r[k] += step[k];
        if (i > 0 && last < refined) break;
        unbalanced = bodies_of(contacts_, r) - y;
        for (std::size_t k = 0; k < n; ++k) {
            rest[k] = right[k] - stiffness_[k].theta * r[k] - contacts_.velocity(k, y);
            for (int d = 1; d < 3; ++d)
                if (!(stiffness_[k].theta(d, d) > 0.0)) rest[k][d] = 0.0;
        }
    }
    return r;
}

/// The change for which products change by target(k, pair) and E db = A^T A dr + row(k).
template <class Target, class Row>
PathChange PathSystem::change(const Target& target, const Row& row) const {
    const std::size_t n = contacts_.size();
    std::vector<Vector3> right(n);
    for (std::size_t k = 0; k < n; ++k) {
        Pairs b{};
        for (int i = 0; i < 5; ++i)
            if (has(k, i)) b[i] = target(k, i) / at_.a[k][i];
        // From db = (target - b da)/a and da = G dr: (Theta + A^T A) dr = E (target/a) - row.
        right[k] = velocity_of(k, b, at_.association) - row(k);
    }
    PathChange result;
    result.r = solve(right);
    result.a.assign(n, {}), result.b.assign(n, {});
    for (std::size_t k = 0; k < n; ++k) {
        result.a[k] = impulse_sides(k, result.r[k]);
        for (int i = 0; i < 5; ++i)
            if (has(k, i))
                result.b[k][i] = (target(k, i) - at_.b[k][i] * result.a[k][i]) / at_.a[k][i];
    }
    result.z = result.association = 0.0;
    return result;
}

/// d(a b) = tau dz,   E db = A^T A dr + dz e - ds (dilation, 0, 0).
PathChange PathSystem::tangent() const {
    const bool products = parameter_ == PathParameter::products;
    const double dz = products ? at_.z : 0.0, ds = products ? 0.0 : 1.0;
    PathChange result =
        change([&](std::size_t, int) { return tau_ * dz; },
               [&](std::size_t k) {
                   return Vector3(dz * offset_[k] - ds * dilation(k, at_.b[k]) * Vector3::UnitX());
               });
    result.z = dz;
    result.association = ds;
    return result;
}

PathChange PathSystem::correction() const {
    return change([this](std::size_t k, int i) { return tau_ * at_.z - at_.a[k][i] * at_.b[k][i]; },
                  [this](std::size_t k) { return defect(k); });
}

/// d2(a b) = 2 da db + a d2b + b d2a = 0,   E d2b = A^T A d2r - 2 ds (dilation of db, 0, 0).
PathChange PathSystem::curvature(const PathChange& velocity) const {
    return change([&](std::size_t k, int i) { return -2.0 * velocity.a[k][i] * velocity.b[k][i]; },
                  [&](std::size_t k) {
                      const double dilating = velocity.association * dilation(k, velocity.b[k]);
                      return Vector3(-2.0 * dilating * Vector3::UnitX());
                  });
}

double PathSystem::deviation(const PathPoint& at) const {
    double worst = 0.0;
    for (std::size_t k = 0; k < at.r.size(); ++k)
        for (int i = 0; i < 5; ++i) {
            if (!has(k, i)) continue;
            if (!(at.a[k][i] > 0.0 && at.b[k][i] > 0.0)) return 1.0;
            const double share = at.a[k][i] * at.b[k][i] / (tau_ * at.z);
            worst = std::max({worst, 1.0 - share, 1.0 - 1.0 / share});
        }
    return worst;
}

double PathSystem::dot(const PathPoint& at, const PathChange& x, const PathChange& y) const {
    const double parameters = (x.z / at.z) * (y.z / at.z) + x.association * y.association;
    double sum = static_cast<double>(at.r.size()) * parameters;
    for (std::size_t k = 0; k < at.r.size(); ++k)
        for (int i = 0; i < 5; ++i)
            if (has(k, i))
                sum += (x.a[k][i] / at.a[k][i]) * (y.a[k][i] / at.a[k][i]) +
                       (x.b[k][i] / at.b[k][i]) * (y.b[k][i] / at.b[k][i]);
    return sum;
}

double PathSystem::decrease(const PathPoint& at, const PathChange& change) const {
    double most = 0.0;
    for (std::size_t k = 0; k < at.r.size(); ++k)
        for (int i = 0; i < 5; ++i)
            if (has(k, i))
                most = std::max({most, -change.a[k][i] / at.a[k][i], -change.b[k][i] / at.b[k][i]});
    return most;
}

}  // namespace turbidite::nscd
