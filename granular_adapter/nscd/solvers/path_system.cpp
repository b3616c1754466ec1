// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/solvers/path_system.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite::nscd {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector = Eigen::VectorXd;

// Added to Theta: a proximal term. Persistent contacts have Theta -> 0, and beyond 1/firmness the
// motions that are free would drown in the rounding of those that are not. Costs nothing at the
// solution, where impulses do not change any more. Relative to W_nn.
constexpr double firmness = 1e-7;

constexpr int most_refinements = 10;
constexpr double refined = 1e-11;  ///< relative change that is small enough
constexpr double halting = 0.9;    ///< reduction per refinement that is not worth another

/// E b.
Vector3d velocity_of(const Pairs& b) {
    return {b[0], b[1] - b[2], b[3] - b[4]};
}

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
}

PathSystem::PathSystem(const ScaledContacts& contacts, double size)
    : contacts_(contacts), factors_(contacts) {
    const std::size_t n = contacts.size();
    for (std::size_t k = 0; k < n; ++k) {
        unit_ += contacts[k].free.head<2>().squaredNorm();
        has_.push_back((contacts[k].friction > 0.0 ? 7 : 1) | (contacts[k].rolling > 0.0 ? 24 : 0));
    }
    unit_ = std::sqrt(unit_ / static_cast<double>(n));
    const double r = size * unit_;
    tau_ = r * r;
    start_.r.assign(n, Vector3(r, 0.0, 0.0));
    start_.a.assign(n, {}), start_.b.assign(n, {});
    const Vector y = bodies_of(contacts, start_.r);
    for (std::size_t k = 0; k < n; ++k) {
        start_.a[k] = impulse_sides(k, start_.r[k]);
        for (int i = 0; i < 5; ++i)
            if (has(k, i)) start_.b[k][i] = tau_ / start_.a[k][i];
        const Vector3 u = contacts.velocity(k, y) + contacts[k].free;
        Vector3 e = velocity_of(start_.b[k]) - u;
        if (!has(k, 1)) e[1] = 0.0;
        if (!has(k, 3)) e[2] = 0.0;
        offset_.push_back(e);
    }
    theta_.resize(n), inverse_.resize(n);
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

/// u + z e - E b, zero in directions that nothing resists.
PathSystem::Vector3 PathSystem::defect(std::size_t k) const {
    Vector3 d =
        contacts_.velocity(k, y_) + contacts_[k].free + at_.z * offset_[k] - velocity_of(at_.b[k]);
    if (!has(k, 1)) d[1] = 0.0;
    if (!has(k, 3)) d[2] = 0.0;
    return d;
}

/// Theta; rows of directions that nothing resists are zero.
Matrix3d PathSystem::stiffness(std::size_t k) const {
    const Pairs &a = at_.a[k], &b = at_.b[k];
    Matrix3d theta = Matrix3d::Zero();
    theta(0, 0) = b[0] / a[0] + firmness;
    for (int d = 1; d < 3; ++d) {
        const int up = 2 * d - 1, down = 2 * d;
        if (!has(k, up)) continue;
        const double p = b[up] / a[up], m = b[down] / a[down];
        theta(d, 0) = limit(k, up) * (p - m);
        theta(d, d) = p + m + firmness;
    }
    return theta;
}

/// Theta^-1 right, zero in directions that nothing resists.
PathSystem::Vector3 PathSystem::flexible(std::size_t k, const Vector3& right) const {
    const Matrix3d& theta = theta_[k];
    Vector3 x(right[0] / theta(0, 0), 0.0, 0.0);
    for (int d = 1; d < 3; ++d)
        if (theta(d, d) > 0.0) x[d] = (right[d] - theta(d, 0) * x[0]) / theta(d, d);
    return x;
}

bool PathSystem::linearise(const PathPoint& at) {
    at_ = at;
    y_ = bodies_of(contacts_, at.r);
    for (std::size_t k = 0; k < at.r.size(); ++k) {
        theta_[k] = stiffness(k);
        for (int d = 0; d < 3; ++d) inverse_[k].col(d) = flexible(k, Vector3::Unit(d));
    }
    return factors_.factorise(inverse_);
}

/// dr with Theta dr + A^T dy = right, dy = A dr, refined in both so that persistent contacts, whose
/// impulses are velocities times 1/Theta, lose no digits.
std::vector<Vector3d> PathSystem::solve(const std::vector<Vector3>& right) const {
    const std::size_t n = right.size();
    std::vector<Vector3> r(n, Vector3::Zero()), rest = right, step(n);
    Vector y = Vector::Zero(y_.size()), unbalanced = y;
    double last = 0.0;
    for (int i = 0; i <= most_refinements; ++i) {
        for (std::size_t k = 0; k < n; ++k) contacts_.push(k, flexible(k, rest[k]), unbalanced);
        const Vector moved = factors_.solve(unbalanced);
        for (std::size_t k = 0; k < n; ++k)
            step[k] = flexible(k, rest[k] - contacts_.velocity(k, moved));
        if (i > 0) {
            const double change = moved.norm() / y.norm() + std::sqrt(squared(step) / squared(r));
            if (!(i == 1 || change < halting * last)) break;
            last = change;
        }
        y += moved;
        for (std::size_t k = 0; k < n; ++k) r[k] += step[k];
        if (i > 0 && last < refined) break;
        unbalanced = bodies_of(contacts_, r) - y;
        for (std::size_t k = 0; k < n; ++k) {
            rest[k] = right[k] - theta_[k] * r[k] - contacts_.velocity(k, y);
            for (int d = 1; d < 3; ++d)
                if (!(theta_[k](d, d) > 0.0)) rest[k][d] = 0.0;
        }
    }
    return r;
}

/// With products that change by target(k, pair) and velocity sides that take up row(k).
template <class Target, class Row>
PathChange PathSystem::change(const Target& target, const Row& row) const {
    const std::size_t n = contacts_.size();
    std::vector<Vector3> right(n);
    for (std::size_t k = 0; k < n; ++k) {
        Pairs b{};
        for (int i = 0; i < 5; ++i)
            if (has(k, i)) b[i] = target(k, i) / at_.a[k][i];
        right[k] = velocity_of(b) - row(k);
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
    result.z = 0.0;
    return result;
}

PathChange PathSystem::tangent() const {
    PathChange result = change([this](std::size_t, int) { return tau_ * at_.z; },
                               [this](std::size_t k) { return Vector3(at_.z * offset_[k]); });
    result.z = at_.z;
    return result;
}

PathChange PathSystem::correction() const {
    return change([this](std::size_t k, int i) { return tau_ * at_.z - at_.a[k][i] * at_.b[k][i]; },
                  [this](std::size_t k) { return defect(k); });
}

PathChange PathSystem::curvature(const PathChange& velocity) const {
    return change([&](std::size_t k, int i) { return -2.0 * velocity.a[k][i] * velocity.b[k][i]; },
                  [](std::size_t) { return Vector3(Vector3::Zero()); });
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
    double sum = static_cast<double>(at.r.size()) * (x.z / at.z) * (y.z / at.z);
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
