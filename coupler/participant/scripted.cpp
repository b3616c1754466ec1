// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/participant/scripted.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "coupler/protocol/wire.hpp"

namespace turbidite {
namespace {

constexpr double everywhere = std::numeric_limits<double>::max();

Vec3 plus(const Vec3& a, double s, const Vec3& b) {
    return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

double distance(const Vec3& a, const Vec3& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

void ScriptedBodies::initialise(const Settings& settings, const ShapeTable& shapes) {
    shapes_.clear();
    for (const ShapeRecord& record : shapes) shapes_.push_back(make_shape(record));
    fluid_density_ = settings.flag("fluid.enabled") ? settings.real("run.fluid_density") : 0.0;
    hydrodynamic_radius_ = settings.real("fluid.hydrodynamic_radius");
    gravity_ = settings.real("run.gravity");
}

ImmersedBody ScriptedBodies::body(const GrainState& grain) const {
    return immersed_body(*shapes_.at(grain.shape), grain.radius, grain.density, fluid_density_,
                         hydrodynamic_radius_);
}

ScriptedGrains::ScriptedGrains(std::string adapter_name, Fault fault)
    : floor_(-everywhere), fault_(std::move(fault)) {
    hello_.adapter = std::move(adapter_name);
    hello_.adapter_version = "scripted";
    hello_.host_code = "script";
    hello_.capabilities.shapes = {"disc"};
    hello_.capabilities.effective_inertia = true;
    hello_.capabilities.serialises_state = true;
}

void ScriptedGrains::reach(const char* function, std::int64_t window) const {
    if (fault_) fault_(function, window);
}

Hello ScriptedGrains::describe() const {
    reach("describe", -1);
    return hello_;
}

Motion ScriptedGrains::initialise(const Settings& settings, const ShapeTable& shapes,
                                  const std::vector<GrainState>& grains) {
    reach("initialise", -1);
    bodies_.initialise(settings, shapes);
    joint_ = settings.flag("fluid.enabled") && settings.text("coupling.scheme") == "joint";
    motion_.grains = grains;
    return motion_;
}

void ScriptedGrains::touch_floor(GrainState& grain, double mass, double step) {
    const double gap = grain.position[1] - grain.radius - floor_;
    const double impulse = std::max(0.0, -mass * (grain.velocity[1] + gap / step));
    grain.velocity[1] += impulse / mass;
    grain.contact_impulse = {0.0, impulse, 0.0};
    if (impulse == 0.0) return;
    ++motion_.report.contacts;
    ContactRecord contact;
    contact.b = grain.id;
    contact.wall = 2;
    contact.status = ContactStatus::sliding;
    contact.gap = gap;
    contact.point = {grain.position[0], grain.position[1] - grain.radius, 0.0};
    contact.normal = {0.0, 1.0, 0.0};
    contact.branch = {0.0, grain.radius, 0.0};
    contact.impulse = grain.contact_impulse;
    contacts_.push_back(contact);
}

Motion ScriptedGrains::advance(const Window& window, const std::vector<FreeResponse>& responses) {
    reach("advance", window.index);
    std::unordered_map<GrainId, const FreeResponse*> by_id;
    for (const FreeResponse& response : responses) by_id[response.id] = &response;
    motion_.report = {};
    motion_.report.iterations = 1;
    motion_.contacts.reset();
    contacts_.clear();
    contact_velocities_.clear();
    for (GrainState& grain : motion_.grains) {
        const ImmersedBody body = bodies_.body(grain);
        double mass = body.effective_mass;
        if (joint_) {
            const FreeResponse& response = *by_id.at(grain.id);
            grain.velocity = response.velocity;
            grain.angular_velocity = response.angular_velocity;
            mass = response.inertia[upper_entry(1, 1)];
        } else {
            grain.velocity[1] -= body.submerged_mass / mass * bodies_.gravity() * window.step;
        }
        touch_floor(grain, mass, window.step);
        contact_velocities_.push_back(grain.velocity);
    }
    return motion_;
}

Motion ScriptedGrains::apply_kick(const Window& window, const std::vector<Kick>& kicks) {
    reach("apply_kick", window.index);
    std::unordered_map<GrainId, const Kick*> by_id;
    for (const Kick& kick : kicks) by_id[kick.id] = &kick;
    for (std::size_t i = 0; i < motion_.grains.size(); ++i) {
        GrainState& grain = motion_.grains[i];
        if (!kicks.empty()) {
            grain.velocity = by_id.at(grain.id)->velocity;
            grain.angular_velocity = by_id.at(grain.id)->angular_velocity;
        }
        const Vec3& carrier = joint_ ? contact_velocities_[i] : grain.velocity;
        grain.position = plus(grain.position, window.step, carrier);
        const double overlap = floor_ - (grain.position[1] - grain.radius);
        motion_.report.max_penetration = std::max(motion_.report.max_penetration, overlap);
    }
    if (window.write_output) motion_.contacts = contacts_;
    return motion_;
}

SavedState ScriptedGrains::save() const {
    return encode(motion_);
}
void ScriptedGrains::restore(const SavedState& state) {
    motion_ = decode<Motion>(state);
}

ScriptedFluid::ScriptedFluid(double drag, int rank, int ranks, Fault fault)
    : drag_(drag), rank_(rank), ranks_(ranks), fault_(std::move(fault)) {}

void ScriptedFluid::reach(const char* function, std::int64_t window) const {
    if (fault_) fault_(function, window);
}

Hello ScriptedFluid::describe() const {
    reach("describe", -1);
    Hello hello;
    hello.adapter = "scripted-fluid";
    hello.adapter_version = "scripted";
    hello.host_code = "script";
    hello.capabilities.shapes = {"disc"};
    hello.capabilities.effective_inertia = true;
    hello.capabilities.serialises_state = true;
    return hello;
}

Box ScriptedFluid::initialise(const Settings& settings, const ShapeTable& shapes) {
    reach("initialise", -1);
    bodies_.initialise(settings, shapes);
    joint_ = settings.text("coupling.scheme") == "joint";
    const double slice = settings.real("run.size_x") / ranks_;
    box_ = {{rank_ * slice, -everywhere, -everywhere},
            {(rank_ + 1) * slice, everywhere, everywhere}};
    if (rank_ == 0) box_.lower[0] = -everywhere;
    if (rank_ + 1 == ranks_) box_.upper[0] = everywhere;
    return box_;
}

bool ScriptedFluid::owns(const GrainState& grain) const {
    return grain.position[0] >= box_.lower[0] && grain.position[0] < box_.upper[0];
}

void ScriptedFluid::advance(const Window& window) {
    reach("advance", window.index);
}

ScriptedFluid::FreeGrain ScriptedFluid::fall(const GrainState& grain, double step) const {
    const ImmersedBody body = bodies_.body(grain);
    FreeGrain motion;
    motion.mass = body.effective_mass + drag_ * step;
    motion.inertia = body.effective_inertia(2, 2);
    const Vec3 weight{0.0, -body.submerged_mass * bodies_.gravity(), 0.0};
    const Vec3 coasting = plus({}, body.effective_mass / motion.mass, grain.velocity);
    motion.velocity = plus(coasting, step / motion.mass, weight);
    motion.angular_velocity = grain.angular_velocity;
    return motion;
}

FreeResponse ScriptedFluid::response(GrainId id, const FreeGrain& motion) const {
    FreeResponse response;
    response.id = id;
    response.velocity = motion.velocity;
    response.angular_velocity = motion.angular_velocity;
    for (std::size_t i = 0; i < 6; ++i)
        response.inertia[upper_entry(i, i)] = told_ * (i < 3 ? motion.mass : motion.inertia);
    return response;
}

std::vector<FreeResponse> ScriptedFluid::respond(const Window& window,
                                                 const std::vector<GrainState>& grains) {
    reach("respond", window.index);
    free_.clear();
    std::vector<FreeResponse> responses;
    for (const GrainState& grain : grains) {
        if (!owns(grain)) continue;
        const FreeGrain& motion = free_[grain.id] = fall(grain, window.step);
        responses.push_back(response(grain.id, motion));
    }
    return responses;
}

ScriptedFluid::FreeGrain ScriptedFluid::pushed(const GrainState& grain) const {
    FreeGrain motion = free_.at(grain.id);
    motion.velocity = plus(motion.velocity, 1.0 / motion.mass, grain.contact_impulse);
    motion.angular_velocity =
        plus(motion.angular_velocity, 1.0 / motion.inertia, grain.contact_angular_impulse);
    return motion;
}

std::vector<FreeResponse> ScriptedFluid::correct(const Window& window,
                                                 const std::vector<GrainState>& grains) {
    reach("correct", window.index);
    std::vector<FreeResponse> responses;
    for (const GrainState& grain : grains) {
        if (!owns(grain)) continue;
        const FreeGrain motion = pushed(grain);
        FreeResponse answer = response(grain.id, motion);
        answer.velocity =
            plus(answer.velocity, -1.0 / (told_ * motion.mass), grain.contact_impulse);
        answer.angular_velocity = plus(answer.angular_velocity, -1.0 / (told_ * motion.inertia),
                                       grain.contact_angular_impulse);
        answer.mismatch = distance(motion.velocity, grain.velocity) +
                          grain.radius * distance(motion.angular_velocity, grain.angular_velocity);
        responses.push_back(answer);
    }
    return responses;
}

Kicks ScriptedFluid::impose(const Window& window, const std::vector<GrainState>& grains) {
    reach("impose", window.index);
    Kicks answer;
    for (const GrainState& grain : grains) {
        if (!owns(grain)) continue;
        Kick kick;
        kick.id = grain.id;
        if (joint_) {
            const FreeGrain motion = pushed(grain);
            kick.velocity = motion.velocity;
            kick.angular_velocity = motion.angular_velocity;
        } else {
            const double mass = bodies_.body(grain).effective_mass;
            kick.velocity = plus({}, 1.0 / (1.0 + drag_ * window.step / mass), grain.velocity);
            kick.angular_velocity = grain.angular_velocity;
        }
        kick.multiplier_impulse = plus({}, -drag_ * window.step, kick.velocity);
        answer.kicks.push_back(kick);
    }
    return answer;
}

SavedState ScriptedFluid::save() const {
    return {};
}
void ScriptedFluid::restore(const SavedState&) {}

}  // namespace turbidite
