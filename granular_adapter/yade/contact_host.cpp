// SPDX-License-Identifier: GPL-3.0-or-later
#include "granular_adapter/yade/contact_host.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "granular_adapter/nscd/vec3.hpp"

namespace turbidite::yade {
namespace {

using nscd::operator+;
using nscd::operator*;

Quaternion product(const Quaternion& p, const Quaternion& q) {
    return {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
            p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
            p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

Quaternion conjugate(const Quaternion& q) {
    return {q[0], -q[1], -q[2], -q[3]};
}

bool is_identity(const Quaternion& q) {
    return q == Quaternion{1.0, 0.0, 0.0, 0.0};
}

/// The part of a rotation about z; what is left is rounding of YADE's principal axes.
Quaternion about_z(const Quaternion& q) {
    if (q[1] == 0.0 && q[2] == 0.0) return q;
    const double length = std::hypot(q[0], q[3]);
    return {q[0] / length, 0.0, 0.0, q[3] / length};
}

Quaternion outline_orientation(const Quaternion& yade, const Turn& turn) {
    if (!turn.planar) return yade;
    return about_z(is_identity(turn.rotation) ? yade : product(yade, conjugate(turn.rotation)));
}

Quaternion yade_orientation(const Quaternion& outline, const Turn& turn) {
    return is_identity(turn.rotation) ? outline : product(outline, turn.rotation);
}

}  // namespace

ContactHost::ContactHost(const nscd::EngineSettings& settings) : settings_(settings) {
    lay_out({});
}

void ContactHost::lay_out(Layout layout) {
    settings_.box = layout.box;
    auto next = std::make_unique<nscd::Engine>(settings_, layout.shapes, std::move(layout.walls));
    for (const nscd::Body& body : layout.bodies) next->bodies().add(body);
    if (engine_) next->restore_memory(engine_->save_memory());
    engine_ = std::move(next);
    states_ = std::move(layout.states);
    turns_ = std::move(layout.turns);
    watch_ = std::move(layout.watch);
    read_bodies();
    check_bodies("at the start");
}

nscd::StepReport ContactHost::step(double dt, const Loads& loads) {
    read_bodies();
    take_loads(loads);
    check_bodies("before the step");
    solved_positions_ = engine_->bodies().position;
    const nscd::StepReport report = engine_->step(dt);
    engine_->move(dt);
    check_bodies("after the step");
    write_bodies();
    last_step_ = dt;
    return report;
}

std::vector<ContactForce> ContactHost::contacts() const {
    const nscd::Bodies& bodies = std::as_const(*engine_).bodies();
    const auto& points = engine_->points();
    std::vector<ContactForce> result;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec3 force = (1.0 / last_step_) * engine_->impulses()[k];
        if (force == Vec3{}) continue;
        const nscd::ContactPoint& point = points[k];
        const auto b = static_cast<std::size_t>(point.b);
        ContactForce contact;
        contact.wall = point.wall >= 0;
        contact.first = contact.wall ? engine_->walls()[static_cast<std::size_t>(point.wall)].key
                                     : bodies.id[static_cast<std::size_t>(point.a)];
        contact.second = bodies.id[b];
        contact.point = solved_positions_[b] + point.arm_b;
        contact.point[2] = heights_[b];
        contact.normal = point.normal;
        contact.gap = point.gap;
        contact.normal_force = force[0];
        contact.tangential_force = force[1];
        contact.rolling_moment = force[2];
        result.push_back(contact);
    }
    return result;
}

void ContactHost::read_bodies() {
    nscd::Bodies& bodies = engine_->bodies();
    heights_.resize(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const BodyMotion motion = states_.read(i);
        heights_[i] = motion.position[2];
        bodies.position[i] = {motion.position[0], motion.position[1], 0.0};
        bodies.orientation[i] = outline_orientation(motion.orientation, turns_[i]);
        bodies.twist[i] = {{motion.velocity[0], motion.velocity[1], 0.0},
                           {0.0, 0.0, motion.angular_velocity[2]}};
    }
}

void ContactHost::take_loads(const Loads& loads) {
    nscd::Bodies& bodies = engine_->bodies();
    bodies.force = loads.force.empty() ? std::vector<Vec3>(bodies.size()) : loads.force;
    bodies.torque = loads.torque.empty() ? std::vector<Vec3>(bodies.size()) : loads.torque;
}

void ContactHost::check_bodies(const char* when) const {
    const nscd::Bodies& bodies = std::as_const(*engine_).bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (!nscd::is_finite(bodies.position[i]) || !nscd::is_finite(bodies.twist[i].velocity) ||
            !nscd::is_finite(bodies.twist[i].spin))
            throw std::runtime_error("turbidite_contact: body " + std::to_string(bodies.id[i]) +
                                     " has a position or velocity that is not a number, " + when +
                                     "; use a smaller O.dt");
}

void ContactHost::write_bodies() const {
    const nscd::Bodies& bodies = std::as_const(*engine_).bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Vec3& x = bodies.position[i];
        states_.write(i, {{x[0], x[1], heights_[i]},
                          yade_orientation(bodies.orientation[i], turns_[i]),
                          bodies.twist[i].velocity,
                          bodies.twist[i].spin});
    }
}

}  // namespace turbidite::yade
