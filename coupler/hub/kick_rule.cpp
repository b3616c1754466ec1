// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/kick_rule.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "coupler/protocol/failure.hpp"
#include "coupler/rigid/impulse.hpp"
#include "coupler/rigid/rotation.hpp"

namespace turbidite {
namespace {

// R I R^T w with R the rotation of q; inertia tensors are given in the body frame. A rotation in
// the plane leaves what turns about z alone.
Vec3 angular_momentum(const Eigen::Matrix3d& inertia, const Quaternion& q, const Vec3& spin) {
    const bool plane = q[1] == 0.0 && q[2] == 0.0 && spin[0] == 0.0 && spin[1] == 0.0 &&
                       inertia(0, 2) == 0.0 && inertia(1, 2) == 0.0;
    if (plane) return {0.0, 0.0, inertia(2, 2) * spin[2]};
    if (inertia == inertia(0, 0) * Eigen::Matrix3d::Identity())  // a sphere's
        return inertia(0, 0) * spin;
    const Rotation turn = rotation(q);
    // To body axes, times I, and back to world axes.
    const Vec3 own = turn.back(spin);
    const Eigen::Vector3d momentum = inertia * Eigen::Vector3d(own[0], own[1], own[2]);
    return turn({momentum[0], momentum[1], momentum[2]});
}

// I omega / R [kg m/s]
Vec3 spin_momentum(const ImmersedBody& body, const GrainState& grain) {
    return angular_momentum(body.inertia, grain.orientation, grain.angular_velocity) / grain.radius;
}

bool same_velocities(const Kick& kick, const GrainState& grain) {
    return kick.velocity == grain.velocity && kick.angular_velocity == grain.angular_velocity;
}
bool same_impulses(const GrainState& a, const GrainState& b) {
    return a.contact_impulse == b.contact_impulse &&
           a.contact_angular_impulse == b.contact_angular_impulse;
}

// The largest term of a balance, and its residual.
struct Balance {
    double largest = 0.0;
    double rest = 0.0;
    GrainId worst = 0;

    // Terms with their signs: they add up to zero where the equation of motion holds. `momentum`:
    // what the grain had before.
    void add(GrainId grain, const Vec3& momentum, std::initializer_list<Vec3> terms) {
        Vec3 sum{};
        // Where nothing acts on a grain that moves, all terms are the rounding of its velocity.
        largest = std::max(largest, beyond_rounding * norm(momentum));
        for (const Vec3& term : terms) {
            sum = sum + term;
            largest = std::max(largest, norm(term));
        }
        // Also if the sum overflows to NaN, which must not pass for the balance of the next grain.
        if (norm(sum) <= rest || std::isnan(rest)) return;
        rest = norm(sum);
        worst = grain;
    }
};

GrainBalance found(const Balance& linear, const Balance& angular, GrainBalance::Rule rule) {
    // One scale for both, the largest term of any grain: a grain at rest has no scale of its own.
    // The angular terms are divided by R, so that all are momenta [kg m/s].
    const double largest = std::max(linear.largest, angular.largest);
    const Balance& worse =
        angular.rest <= linear.rest || std::isnan(linear.rest) ? linear : angular;
    return {largest > 0.0 ? worse.rest / largest : 0.0, worse.worst, rule, largest};
}

}  // namespace

KickRule::KickRule(const RunValues& run, const ShapeTable& shapes,
                   const std::vector<GrainState>& population)
    : bodies_(run, shapes), gravity_(run.gravity) {
    for (const GrainState& grain : population)
        if (grain.prescribed) given_.insert(grain.id);
}

const ImmersedBody& KickRule::body_of(const GrainState& grain) {
    // Masses and tensors are computed once for a row of equal grains.
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
        // lambda moves the effective inertia M - rho_f V(R_h) alone (shapes/immersed_body.hpp).
        // F_h, which moves all of M, has the rest of that inertia besides.
        const Vec3 velocity_change = kick.velocity - grain.velocity;
        const Vec3 spin_change = kick.angular_velocity - grain.angular_velocity;
        // F_h = (J_lambda + rho_f V dU) / dt, T_h = (K_lambda + I_f domega) / dt
        kick.force = (kick.multiplier_impulse + immersed.displaced_mass * velocity_change) / step;
        kick.torque =
            (kick.multiplier_angular_impulse +
             angular_momentum(immersed.displaced_inertia, grain.orientation, spin_change)) /
            step;
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
        // The force that drives it is not known here and would be the residual.
        if (has_given_motion(grain.id)) continue;
        const GrainState& with_contact = contact.grains.at(at_contact);
        const ImmersedBody& immersed = body_of(grain);
        const Vec3 spin_change = kick.angular_velocity - grain.angular_velocity;
        // M dU - (M - m_f) g dt - J_c - F_h dt; the same for the spin, divided by R
        // Gravity acts along -y, so its term is +(M - m_f) g dt in y. m_f is of V(R): buoyancy acts
        // on the true volume, whatever R_h.
        linear.add(kick.id, immersed.mass * grain.velocity,
                   {immersed.mass * (kick.velocity - grain.velocity),
                    Vec3{0.0, immersed.submerged_mass * gravity_ * step, 0.0},
                    -with_contact.contact_impulse, -step * kick.force});
        angular.add(
            kick.id, spin_momentum(immersed, grain),
            {angular_momentum(immersed.inertia, grain.orientation, spin_change) / grain.radius,
             -with_contact.contact_angular_impulse / grain.radius,
             -step * kick.torque / grain.radius});
    }
    return found(linear, angular, GrainBalance::Rule::wet);
}

GrainBalance KickRule::balance(const Motion& before, const Motion& after, double step) {
    before_.follow(before.grains);
    Balance linear, angular;
    std::size_t at = GrainIndex::nowhere;
    for (const GrainState& now : after.grains) {  // those that have left are no longer known
        at = before_.place(now.id, at + 1);
        const GrainState& grain = before.grains.at(at);
        if (has_given_motion(grain.id)) continue;
        const ImmersedBody& body = body_of(grain);
        const Vec3 spin_change = now.angular_velocity - grain.angular_velocity;
        // M dU - M g dt - J_c; the same for the spin, divided by R
        linear.add(now.id, body.mass * grain.velocity,
                   {body.mass * (now.velocity - grain.velocity),
                    Vec3{0.0, body.mass * gravity_ * step, 0.0}, -now.contact_impulse});
        angular.add(now.id, spin_momentum(body, grain),
                    {angular_momentum(body.inertia, grain.orientation, spin_change) / grain.radius,
                     -now.contact_angular_impulse / grain.radius});
    }
    return found(linear, angular, GrainBalance::Rule::dry);
}

GrainBalance KickRule::with_state(GrainBalance so_far, const std::vector<Kick>& kicks,
                                  const Motion& contact, const Motion& state) {
    contact_.follow(contact.grains);
    state_.follow(state.grains);
    std::size_t at_contact = GrainIndex::nowhere, at_state = at_contact;
    for (const Kick& kick : kicks) {
        at_contact = contact_.place(kick.id, at_contact + 1);
        at_state = state_.place(kick.id, at_state + 1);
        if (at_state == GrainIndex::nowhere) continue;  // it has left
        const GrainState& now = state.grains[at_state];
        if (has_given_motion(now.id)) continue;
        const GrainState& then = contact.grains.at(at_contact);
        if (same_velocities(kick, now) && same_impulses(then, now)) continue;
        const ImmersedBody& body = body_of(now);
        const Vec3 spin_error = now.angular_velocity - kick.angular_velocity;
        // All four as momenta [kg m/s]: M |dU|, |I domega|/R, |dJ_c|, |dK_c|/R.
        const double worst = std::max(
            {body.mass * norm(now.velocity - kick.velocity),
             norm(angular_momentum(body.inertia, now.orientation, spin_error)) / now.radius,
             norm(now.contact_impulse - then.contact_impulse),
             norm(now.contact_angular_impulse - then.contact_angular_impulse) / now.radius});
        // Where the motion is at fault, the state differs from it by as much.
        if (worst <= 2.0 * so_far.defect * so_far.largest) continue;
        // Where nothing else moves there is no scale, and the difference is all there is.
        so_far.largest = std::max(so_far.largest, worst);
        so_far = {worst / so_far.largest, kick.id, GrainBalance::Rule::state, so_far.largest};
    }
    return so_far;
}

}  // namespace turbidite
