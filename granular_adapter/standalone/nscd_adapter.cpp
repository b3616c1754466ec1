// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/standalone/nscd_adapter.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <unordered_set>
#include <utility>

#include "coupler/shapes/immersed_body.hpp"
#include "granular_adapter/nscd/broad_phase.hpp"
#include "granular_adapter/nscd/law_list.hpp"
#include "granular_adapter/nscd/vec3.hpp"
#include "granular_adapter/standalone/by_grain.hpp"
#include "granular_adapter/standalone/contact_records.hpp"
#include "granular_adapter/standalone/contact_settings.hpp"
#include "granular_adapter/standalone/free_motion.hpp"
#include "granular_adapter/standalone/inner_walls.hpp"

namespace turbidite {
namespace {

using nscd::is_finite;

class StopWatch {
 public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

 private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::string place(const Vec3& x) {
    char text[80];
    std::snprintf(text, sizeof text, "(%.6g, %.6g)", x[0], x[1]);
    return text;
}

std::string grain(GrainId id) {
    return "grain " + std::to_string(id);
}

std::string in_window(const Window& window) {
    return "in window " + std::to_string(window.index);
}

nscd::Engine& initialised(const std::unique_ptr<nscd::Engine>& engine) {
    if (!engine) throw std::logic_error("the contact engine is asked before initialise()");
    return *engine;
}

bool is_finite(const nscd::Twist& twist) {
    return is_finite(twist.velocity) && is_finite(twist.spin);
}

/// In the plane.
nscd::Twist twist_of(const Kick& kick) {
    return {{kick.velocity[0], kick.velocity[1], 0.0}, {0.0, 0.0, kick.angular_velocity[2]}};
}

/// What step 4 moves: effective inertia, submerged weight.
nscd::Body immersed(const GrainState& grain, const Shape& shape, double fluid_density,
                    double hydrodynamic_radius) {
    const ImmersedBody inertia =
        immersed_body(shape, grain.radius, grain.density, fluid_density, hydrodynamic_radius);
    nscd::Body body;
    body.id = grain.id;
    body.shape = grain.shape;
    body.radius = grain.radius;
    body.density = grain.density;
    body.mass = inertia.effective_mass;
    body.inertia = inertia.effective_inertia(2, 2);
    body.weight_mass = inertia.submerged_mass;
    body.position = grain.position;
    body.orientation = grain.orientation;
    body.twist = {grain.velocity, grain.angular_velocity};
    return body;
}

void check_grain(const GrainState& state, const ShapeTable& shapes,
                 std::unordered_set<GrainId>& seen) {
    if (!seen.insert(state.id).second)
        throw std::runtime_error(grain(state.id) + " is there twice; ids must be unique");
    if (state.shape < 0 || state.shape >= static_cast<std::int32_t>(shapes.size()))
        throw std::runtime_error(grain(state.id) + " has shape " + std::to_string(state.shape) +
                                 " but the table has " + std::to_string(shapes.size()));
}

}  // namespace

NscdAdapter::NscdAdapter(std::string adapter_name, std::string host_code)
    : adapter_name_(std::move(adapter_name)), host_code_(std::move(host_code)) {}

Hello NscdAdapter::describe() const {
    Hello hello;
    hello.role = Role::grains;
    hello.adapter = adapter_name_;
    hello.adapter_version = TURBIDITE_VERSION;
    hello.host_code = host_code_;
    hello.dimension = 2;
    hello.capabilities.saves_state = true;
    hello.capabilities.restores_within_window = true;
    hello.capabilities.serialises_state = true;
    hello.capabilities.effective_inertia = true;
    for (const auto& entry : nscd::wall_detector_list())
        hello.capabilities.shapes.push_back(entry.kind);
    for (const auto& entry : nscd::law_list())
        if (entry.make) hello.capabilities.contact_laws.push_back(entry.name);
    return hello;
}

Motion NscdAdapter::initialise(const Settings& settings, const ShapeTable& shapes,
                               const std::vector<GrainState>& grains) {
    const StopWatch watch;
    fluid_ = settings.flag("fluid.enabled");
    joint_ = fluid_ && settings.text("coupling.scheme") == "joint";
    positions_ = parse_positions(settings.text("coupling.positions"));
    lay_borders(settings);
    std::vector<nscd::Wall> walls;
    for (const Border& border : borders_)
        if (border.side == Side::wall) walls.push_back(border.plane);
    for (const nscd::Wall& wall : inner_walls(settings, static_cast<std::int32_t>(borders_.size())))
        walls.push_back(wall);
    engine_ = std::make_unique<nscd::Engine>(engine_settings(settings), shapes, walls);
    add_grains(settings, shapes, grains);
    nscd::check_periods(bodies().radius, engine().settings().box);
    check_grains("at the start");
    report_ = {};
    report_.max_penetration = engine_->max_penetration();
    report_.wall_seconds = watch.seconds();
    return motion();
}

Motion NscdAdapter::advance(const Window& window, const std::vector<FreeResponse>& responses) {
    const StopWatch watch;
    begin_round();
    check_grains(in_window(window) + " before contacts");
    report_ = {};
    report_.max_penetration = engine().max_penetration();
    const nscd::StepReport step = solve_contacts(window, responses);
    check_grains(in_window(window) + " after contacts");
    contact_twists_ = bodies().twist;
    report_.contacts = step.contacts;
    report_.iterations = step.iterations;
    report_.residual = step.residual;
    report_.quad = step.change.quad;
    report_.max = step.change.max;
    report_.converged = step.converged;
    report_.wall_seconds = watch.seconds();
    return motion();
}

// An advance that is repeated before the kick begins at t^n again; contact impulses are kept.
void NscdAdapter::begin_round() {
    const bool again = !contact_twists_.empty() && contact_twists_.size() == bodies().size();
    if (again)
        bodies().twist = start_twists_;
    else
        start_twists_ = bodies().twist;
}

nscd::StepReport NscdAdapter::solve_contacts(const Window& window,
                                             const std::vector<FreeResponse>& responses) {
    if (joint_) {
        FreeMotion free = free_motion(bodies(), responses, in_window(window));
        return engine().step_from(free.velocities, std::move(free.mobilities), window.step);
    }
    if (!responses.empty())
        throw std::runtime_error("responses of the fluid came " + in_window(window) +
                                 ", but coupling.scheme is not joint");
    return engine().step(window.step);
}

Motion NscdAdapter::apply_kick(const Window& window, const std::vector<Kick>& kicks) {
    const StopWatch watch;
    if (contact_twists_.size() != bodies().size())
        throw std::logic_error("apply_kick needs an advance of the same window before it");
    if (fluid_ || !kicks.empty()) take_velocities(window, kicks);
    check_grains(in_window(window) + " after the kick");
    std::optional<std::vector<ContactRecord>> contacts;
    if (window.write_output) contacts = contact_records(engine());
    const bool with_contact = joint_ || positions_ == Positions::contact;
    engine().move(window.step, with_contact ? contact_twists_ : bodies().twist);
    contact_twists_.clear();
    remove_leavers();
    check_grains(in_window(window) + " after motion");
    report_.removed = static_cast<std::int64_t>(removed_.size());
    report_.max_penetration = engine().max_penetration();
    Motion result = motion();
    if (contacts) drop_contacts_of(removed_, *contacts);
    result.contacts = std::move(contacts);
    result.report.wall_seconds = report_.wall_seconds = watch.seconds();
    return result;
}

SavedState NscdAdapter::save() const {
    return engine().save();
}

void NscdAdapter::restore(const SavedState& state) {
    engine().restore(state);
    contact_twists_.clear();
    removed_.clear();
}

const nscd::Engine& NscdAdapter::engine() const {
    return initialised(engine_);
}

nscd::Engine& NscdAdapter::engine() {
    return initialised(engine_);
}

NscdAdapter::Side NscdAdapter::parse_side(const std::string& key, const std::string& text) {
    if (text == "wall") return Side::wall;
    if (text == "free") return Side::free;
    if (text == "cyclic") return Side::cyclic;
    throw std::invalid_argument(key + " = \"" + text + "\"; allowed: wall, free, cyclic");
}

NscdAdapter::Positions NscdAdapter::parse_positions(const std::string& text) {
    if (text == "corrected") return Positions::corrected;
    if (text == "contact") return Positions::contact;
    throw std::invalid_argument("coupling.positions = \"" + text +
                                "\"; allowed: corrected, contact");
}

void NscdAdapter::lay_borders(const Settings& settings) {
    const double width = settings.real("run.size_x"), height = settings.real("run.size_y");
    borders_.clear();
    const auto lay = [&](const std::string& name, const Vec3& point, const Vec3& normal) {
        const std::string key = "domain." + name;
        nscd::Wall plane;
        plane.point = point;
        plane.normal = normal;
        plane.material = 0;
        plane.key = static_cast<std::int32_t>(borders_.size());
        borders_.push_back({name, parse_side(key, settings.text(key)), plane});
    };
    lay("left", {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
    lay("right", {width, 0.0, 0.0}, {-1.0, 0.0, 0.0});
    lay("bottom", {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
    lay("top", {0.0, height, 0.0}, {0.0, -1.0, 0.0});
    for (std::size_t low = 0; low < borders_.size(); low += 2)
        if ((borders_[low].side == Side::cyclic) != (borders_[low + 1].side == Side::cyclic))
            throw std::invalid_argument("domain." + borders_[low].name + " and domain." +
                                        borders_[low + 1].name +
                                        " must both be cyclic, or neither");
}

nscd::EngineSettings NscdAdapter::engine_settings(const Settings& settings) const {
    nscd::EngineSettings result = contact_settings(settings);
    result.gravity = {0.0, -settings.real("run.gravity"), 0.0};
    if (borders_[0].side == Side::cyclic) result.box.length[0] = settings.real("run.size_x");
    if (borders_[2].side == Side::cyclic) result.box.length[1] = settings.real("run.size_y");
    return result;
}

void NscdAdapter::add_grains(const Settings& settings, const ShapeTable& shapes,
                             const std::vector<GrainState>& grains) {
    const double fluid_density = fluid_ ? settings.real("run.fluid_density") : 0.0;
    const double wet_radius = fluid_ ? settings.real("fluid.hydrodynamic_radius") : 1.0;
    std::vector<std::shared_ptr<const Shape>> made;
    for (const ShapeRecord& record : shapes) made.push_back(make_shape(record));
    std::unordered_set<GrainId> seen;
    for (const GrainState& state : grains) {
        check_grain(state, shapes, seen);
        const Shape& shape = *made[static_cast<std::size_t>(state.shape)];
        bodies().add(immersed(state, shape, fluid_density, wet_radius));
    }
}

/// Finite, and no centre beyond a wall.
void NscdAdapter::check_grains(const std::string& when) const {
    const nscd::Bodies& all = bodies();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::string who = grain(all.id[i]) + " at " + place(all.position[i]);
        if (!is_finite(all.position[i]) || !is_finite(all.twist[i]))
            throw PhysicsRefused(who + " has a position or velocity that is not a number, " + when +
                                 "; use a smaller time.step");
        for (const Border& border : borders_)
            if (border.side == Side::wall && signed_distance(border.plane, all.position[i]) < 0.0)
                throw PhysicsRefused(who + " has its centre beyond the " + border.name + " wall, " +
                                     when + "; use a smaller time.step");
    }
}

/// Every grain gets exactly one kick; grains keep the order they have.
void NscdAdapter::take_velocities(const Window& window, const std::vector<Kick>& kicks) {
    const auto ordered = by_grain(bodies().id, kicks, "kick", in_window(window));
    for (std::size_t i = 0; i < bodies().size(); ++i) bodies().twist[i] = twist_of(*ordered[i]);
}

void NscdAdapter::remove_leavers() {
    const nscd::Bodies& all = bodies();
    std::vector<std::uint8_t> stays(all.size(), 1);
    removed_.clear();
    for (std::size_t i = 0; i < all.size(); ++i)
        for (const Border& border : borders_)
            if (border.side == Side::free &&
                signed_distance(border.plane, all.position[i]) < -all.radius[i])
                stays[i] = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (!stays[i]) removed_.push_back(all.id[i]);
    if (!removed_.empty()) engine().keep(stays);
}

Motion NscdAdapter::motion() const {
    const nscd::Bodies& all = bodies();
    Motion result;
    result.report = report_;
    result.grains.resize(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        GrainState& state = result.grains[i];
        state.id = all.id[i];
        state.shape = all.shape[i];
        state.radius = all.radius[i];
        state.density = all.density[i];
        state.position = all.position[i];
        state.orientation = all.orientation[i];
        state.velocity = all.twist[i].velocity;
        state.angular_velocity = all.twist[i].spin;
        state.contact_impulse = all.contact_impulse[i];
        state.contact_angular_impulse = all.contact_angular_impulse[i];
    }
    return result;
}

}  // namespace turbidite
