// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/kick_rule.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

Eigen::Vector3d vector(const Vec3& v) {
    return {v[0], v[1], v[2]};
}
Vec3 array(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

// R I R^T w with R the rotation matrix of q; inertia tensors are given in the body frame. A
// rotation in the plane leaves what turns about z alone.
Eigen::Vector3d angular_momentum(const Eigen::Matrix3d& inertia, const Quaternion& q,
                                 const Eigen::Vector3d& spin) {
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const bool plane = x == 0.0 && y == 0.0 && spin.x() == 0.0 && spin.y() == 0.0 &&
                       inertia(0, 2) == 0.0 && inertia(1, 2) == 0.0;
    if (plane) return {0.0, 0.0, inertia(2, 2) * spin.z()};
    Eigen::Matrix3d rotation;
    rotation << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
        2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 2 * (x * z - w * y),
        2 * (y * z + w * x), 1 - 2 * (x * x + y * y);
    return rotation * (inertia * (rotation.transpose() * spin));
}

// The largest term of a balance, and its residual.
struct Balance {
    double largest = 0.0;
    double rest = 0.0;
    GrainId worst = 0;

    void add(GrainId grain, std::initializer_list<Eigen::Vector3d> terms) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const auto& term : terms) {
            sum += term;
            largest = std::max(largest, term.norm());
        }
        if (sum.norm() <= rest) return;
        rest = sum.norm();
        worst = grain;
    }
};

}  // namespace

KickRule::KickRule(const RunValues& run, const ShapeTable& shapes)
    : bodies_(run, shapes), gravity_(run.gravity) {}

const ImmersedBody& KickRule::body_of(const GrainState& grain) {
    const bool same = last_body_ && grain.shape == last_.shape && grain.radius == last_.radius &&
                      grain.density == last_.density;
    if (!same) {
        last_body_ = bodies_(grain);
        last_ = grain;
    }
    return *last_body_;
}

void KickRule::complete(std::vector<Kick>& kicks, const Motion& before, double step) {
    before_.follow(before.grains);
    std::size_t at = GrainIndex::nowhere;
    for (Kick& kick : kicks) {
        at = before_.place(kick.id, at + 1);
        if (at == GrainIndex::nowhere)
            throw PhysicsRefused("the fluid sent a kick for grain " + std::to_string(kick.id) +
                                 ", which is unknown");
        const GrainState& grain = before.grains[at];
        const ImmersedBody& immersed = body_of(grain);
        const Eigen::Vector3d velocity_change = vector(kick.velocity) - vector(grain.velocity);
        const Eigen::Vector3d spin_change =
            vector(kick.angular_velocity) - vector(grain.angular_velocity);
        // F_h = (J_lambda + rho_f V dU) / dt, T_h = (K_lambda + I_f domega) / dt
        kick.force = array(
            (vector(kick.multiplier_impulse) + immersed.displaced_mass * velocity_change) / step);
        kick.torque =
            array((vector(kick.multiplier_angular_impulse) +
                   angular_momentum(immersed.displaced_inertia, grain.orientation, spin_change)) /
                  step);
    }
}

GrainBalance KickRule::balance(const std::vector<Kick>& kicks, const Motion& before,
                               const Motion& contact, double step) {
    before_.follow(before.grains);
    contact_.follow(contact.grains);
    Balance linear, angular;
    std::size_t at = GrainIndex::nowhere, at_contact = at;
    for (const Kick& kick : kicks) {
        at = before_.place(kick.id, at + 1);
        at_contact = contact_.place(kick.id, at_contact + 1);
        const GrainState& grain = before.grains.at(at);
        if (grain.prescribed) continue;  // what holds it takes the rest
        const GrainState& with_contact = contact.grains.at(at_contact);
        const ImmersedBody& immersed = body_of(grain);
        const Eigen::Vector3d velocity_change = vector(kick.velocity) - vector(grain.velocity);
        const Eigen::Vector3d spin_change =
            vector(kick.angular_velocity) - vector(grain.angular_velocity);
        // M dU - (M - m_f) g dt - J_c - F_h dt; the same for the spin, divided by R
        linear.add(kick.id, {immersed.mass * velocity_change,
                             Eigen::Vector3d(0.0, immersed.submerged_mass * gravity_ * step, 0.0),
                             -vector(with_contact.contact_impulse), -step * vector(kick.force)});
        angular.add(kick.id, {angular_momentum(immersed.inertia, grain.orientation, spin_change) /
                                  grain.radius,
                              -vector(with_contact.contact_angular_impulse) / grain.radius,
                              -step * vector(kick.torque) / grain.radius});
    }
    const double largest = std::max(linear.largest, angular.largest);
    const Balance& worse = linear.rest >= angular.rest ? linear : angular;
    return {largest > 0.0 ? worse.rest / largest : 0.0, worse.worst};
}

}  // namespace turbidite
