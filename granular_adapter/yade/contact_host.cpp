// SPDX-License-Identifier: GPL-3.0-or-later
#include "granular_adapter/yade/contact_host.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/yade/engine_memory.hpp"

namespace turbidite::yade {
namespace {

std::runtime_error at_fault(GrainId body, const std::string& fault, const char* when) {
    return std::runtime_error("turbidite_contact: body " + std::to_string(body) + fault + ", " +
                              when + "; use a smaller O.dt");
}

bool has_finite_motion(const nscd::Bodies& bodies, std::size_t i) {
    return is_finite(bodies.position[i]) && is_finite(bodies.twist[i].velocity) &&
           is_finite(bodies.twist[i].spin);
}

}  // namespace

ContactHost::ContactHost(const nscd::EngineSettings& settings) : settings_(settings) {
    lay_out({});
}

/// By material of the scene; without any the engine has no bodies yet, and the law of a pair of
/// surfaces is only asked whether its numbers make sense.
std::vector<nscd::Surface> ContactHost::surfaces(const std::vector<double>& frictions) const {
    std::vector<nscd::Surface> result;
    for (const double friction : frictions.empty() ? std::vector{0.0} : frictions) {
        result.push_back(settings_.surfaces.at(0));
        result.back().friction = friction;
        // A material rougher than the law's static friction: its contacts slide with their own.
        result.back().static_friction = std::max(result.back().static_friction, friction);
    }
    return result;
}

std::unique_ptr<nscd::Engine> ContactHost::new_engine(Layout& layout) const {
    nscd::EngineSettings settings = settings_;
    settings.box = layout.box;
    settings.dimension = layout.dimension;
    if (layout.dimension == 2 && !layout.bodies.empty() && settings.gravity[2] != 0.0)
        throw std::runtime_error(
            "turbidite_contact: gravity has a z component, but the bodies move in the plane");
    settings.surfaces = surfaces(layout.frictions);
    auto engine = std::make_unique<nscd::Engine>(settings, layout.shapes,
                                                 layout.walls.read(layout.dimension));
    for (const nscd::Body& body : layout.bodies) engine->bodies().add(body);
    return engine;
}

void ContactHost::lay_out(Layout layout) {
    auto next = new_engine(layout);
    // The memory that a script has restored, otherwise that of the scene before. Contacts of the
    // plane and of space are remembered in different forms.
    if (!given_memory_.empty())
        restore_contact_memory(*next, std::exchange(given_memory_, {}));
    else if (engine_ && engine_->settings().dimension == layout.dimension)
        restore_contact_memory(*next, contact_memory(*engine_));
    engine_ = std::move(next);
    shapes_ = std::move(layout.shapes);
    states_ = std::move(layout.states);
    turns_ = std::move(layout.turns);
    walls_ = std::move(layout.walls);
    watch_ = std::move(layout.watch);
    read_bodies();
    check_bodies("at the start");
}

nscd::StepReport ContactHost::step(double dt, const Loads& loads) {
    read_bodies();
    take_loads(loads);
    check_bodies("before the step");
    // Contact points are reported where they were found, before the move.
    solved_positions_ = engine_->bodies().position;
    const nscd::StepReport report = engine_->step(dt);
    engine_->move(dt);
    check_bodies("after the step");
    write_bodies();
    walls_.advance(dt);
    last_step_ = dt;
    return report;
}

std::vector<char> ContactHost::memory() const {
    return contact_memory(*engine_);
}

void ContactHost::restore_memory(const std::vector<char>& bytes) {
    if (std::as_const(*engine_).bodies().size() == 0)
        given_memory_ = bytes;  // of the scene that is laid out next, whatever its dimension
    else
        restore_contact_memory(*engine_, bytes);
}

std::optional<Overlap> ContactHost::overlap() const {
    const nscd::Engine& engine = *engine_;
    return largest_overlap(engine.bodies(), shapes_, engine.walls(), engine.settings().box);
}

std::vector<ContactForce> ContactHost::contacts() const {
    const nscd::Bodies& bodies = std::as_const(*engine_).bodies();
    const std::vector<nscd::Wall>& walls = engine_->walls_of_points();
    const auto& points = engine_->points();
    std::vector<ContactForce> result;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const nscd::ContactVector force = (1.0 / last_step_) * engine_->impulses()[k];
        if (force == nscd::ContactVector{}) continue;
        const nscd::ContactPoint& point = points[k];
        const auto b = static_cast<std::size_t>(point.b);
        ContactForce contact;
        contact.wall = point.wall >= 0;
        contact.first = contact.wall ? walls[static_cast<std::size_t>(point.wall)].key
                                     : bodies.id[static_cast<std::size_t>(point.a)];
        contact.second = bodies.id[b];
        contact.point = solved_positions_[b] + point.arm_b;
        if (!in_space()) contact.point[2] = heights_[b];
        contact.normal = point.normal;
        contact.gap = point.gap;
        contact.normal_force = force.n;
        const nscd::Contact& frame = engine_->problem().contacts[k];
        contact.shear_force = nscd::world_impulse(frame, {0.0, force.t, force.s, 0.0});
        const Vec3 moment = (1.0 / last_step_) * nscd::world_moment(engine_->impulses(), k);
        // In space its size, without the part along the normal, which is torsion.
        contact.rolling_moment =
            in_space() ? norm(moment - dot(moment, point.normal) * point.normal) : moment[2];
        result.push_back(contact);
    }
    return result;
}

void ContactHost::read_bodies() {
    nscd::Bodies& bodies = engine_->bodies();
    heights_.resize(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const BodyMotion motion = states_.read(i);
        bodies.position[i] = motion.position;
        bodies.orientation[i] = outline_orientation(motion.orientation, turns_[i]);
        bodies.twist[i] = motion.twist;
        if (in_space()) continue;
        // The plane of the engine is z = 0; each body keeps its own height in YADE.
        heights_[i] = std::exchange(bodies.position[i][2], 0.0);
        bodies.twist[i] = in_plane(motion.twist);
    }
    engine_->walls() = walls_.read(engine_->settings().dimension);
}

void ContactHost::take_loads(const Loads& loads) {
    nscd::Bodies& bodies = engine_->bodies();
    bodies.force = loads.force.empty() ? std::vector<Vec3>(bodies.size()) : loads.force;
    bodies.torque = loads.torque.empty() ? std::vector<Vec3>(bodies.size()) : loads.torque;
}

/// Throws unless all motions are finite and no centre is behind a half-plane.
void ContactHost::check_bodies(const char* when) const {
    const nscd::Bodies& bodies = std::as_const(*engine_).bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (!has_finite_motion(bodies, i))
            throw at_fault(bodies.id[i], " has a position or velocity that is not finite", when);
        if (bodies.fixed[i]) continue;
        for (const nscd::Wall& wall : std::as_const(*engine_).walls())
            // Plates hold bodies on both sides: nothing is behind them.
            if (!has_ends(wall) && signed_distance(wall, bodies.position[i]) < 0.0)
                throw at_fault(bodies.id[i],
                               " has its centre behind wall " + std::to_string(wall.key), when);
    }
}

void ContactHost::write_bodies() const {
    const nscd::Bodies& bodies = std::as_const(*engine_).bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        Vec3 place = bodies.position[i];
        if (!in_space()) place[2] = heights_[i];
        states_.write(i,
                      {place, yade_orientation(bodies.orientation[i], turns_[i]), bodies.twist[i]});
    }
}

}  // namespace turbidite::yade
