// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/solvers/plane/scaled_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/problem/plane/delassus.hpp"
#include "granular_adapter/nscd/problem/plane/rolling_contact.hpp"

namespace turbidite::nscd {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Lower triangular L with L L^T = M^-1; the column of an immovable direction is zero.
Matrix3d root(const BodyMobility& m) {
    // Cholesky's factor; a semi-definite M^-1 has zero pivots.
    const auto over = [](double value, double pivot) { return pivot > 0.0 ? value / pivot : 0.0; };
    Matrix3d l = Matrix3d::Zero();
    l(0, 0) = std::sqrt(m.xx);
    l(1, 0) = over(m.xy, l(0, 0));
    l(2, 0) = over(m.xs, l(0, 0));
    l(1, 1) = std::sqrt(std::max(0.0, m.yy - l(1, 0) * l(1, 0)));
    l(2, 1) = over(m.ys - l(2, 0) * l(1, 0), l(1, 1));
    l(2, 2) = std::sqrt(std::max(0.0, m.ss - l(2, 0) * l(2, 0) - l(2, 1) * l(2, 1)));
    return l;
}

/// H^T L of one body, scaled: rows n, t, roll.
Matrix3d rows(const Contact& contact, const Vec3& arm, const BodyMobility& body,
              const ScaledContact& scales) {
    Matrix3d h;
    h.row(0) << contact.normal[0], contact.normal[1], cross_z(arm, contact.normal);
    h.row(1) << contact.tangent[0], contact.tangent[1], cross_z(arm, contact.tangent);
    h.row(2) << 0.0, 0.0, scales.length;
    // A^T = H^T L/sqrt(W_nn), so that (A^T A)_nn = 1: velocities are divided by sqrt(W_nn), and
    // impulses multiplied.
    return h * root(body) / scales.impulse;
}

}  // namespace

ScaledContacts::ScaledContacts(const ContactProblem& problem, const Delassus& w)
    : bodies_(w.bodies().size()) {
    contacts_.reserve(problem.contacts.size());
    for (std::size_t k = 0; k < problem.contacts.size(); ++k) {
        const Contact& contact = problem.contacts[k];
        const Block& block = w.block(k);
        ScaledContact scaled;
        scaled.a = contact.a, scaled.b = contact.b;
        scaled.impulse = std::sqrt(block.nn);
        scaled.length = block.rr > 0.0 ? rolling_length(block) : 0.0;
        scaled.friction = contact.friction;
        // |m| <= rolling r_n, with the moment over `length` in the units of an impulse.
        scaled.rolling = block.rr > 0.0 ? contact.rolling / scaled.length : 0.0;
        scaled.at_b = rows(contact, contact.arm_b, w.bodies()[contact.b], scaled);
        if (contact.a >= 0)
            scaled.at_a = rows(contact, contact.arm_a, w.bodies()[contact.a], scaled);
        const ContactVector u = contact_velocity(contact, problem.free) + contact.bias;
        scaled.free = Vector3d(u.n, u.t, u.roll * scaled.length) / scaled.impulse;
        contacts_.push_back(scaled);
    }
}

Vector3d ScaledContacts::velocity(std::size_t k, const Eigen::VectorXd& y) const {
    const ScaledContact& contact = contacts_[k];
    Vector3d u = contact.at_b * y.segment<3>(3 * contact.b);
    if (contact.a >= 0) u -= contact.at_a * y.segment<3>(3 * contact.a);
    return u;
}

void ScaledContacts::push(std::size_t k, const Vector3d& r, Eigen::VectorXd& y) const {
    const ScaledContact& contact = contacts_[k];
    y.segment<3>(3 * contact.b) += contact.at_b.transpose() * r;
    if (contact.a >= 0) y.segment<3>(3 * contact.a) -= contact.at_a.transpose() * r;
}

ContactVector ScaledContacts::physical(std::size_t k, const Vector3d& r) const {
    const ScaledContact& contact = contacts_[k];
    const double n = std::max(0.0, r[0]) / contact.impulse;
    const double t = r[1] / contact.impulse, m = r[2] * contact.length / contact.impulse;
    const double most = contact.friction * n, turn = contact.rolling * contact.length * n;
    return in_plane(n, std::clamp(t, -most, most), std::clamp(m, -turn, turn));
}

}  // namespace turbidite::nscd
