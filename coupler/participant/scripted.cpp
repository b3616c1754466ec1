// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/participant/scripted.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "coupler/protocol/wire.hpp"
#include "coupler/rigid/rotation.hpp"

namespace turbidite {
namespace {

constexpr double everywhere = std::numeric_limits<double>::max();

}  // namespace

ScriptedGrains::ScriptedGrains(std::string adapter_name, Fault fault)
    : floor_(-everywhere), fault_(std::move(fault)) {
    hello_.adapter = std::move(adapter_name);
    hello_.adapter_version = "scripted";
    hello_.host_code = "script";
    hello_.dimension = both_dimensions;
    hello_.capabilities.shapes = {"disc", "sphere"};
    hello_.capabilities.effective_inertia = true;
    hello_.capabilities.saves_state = true;
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
    const RunValues run = run_values(settings);
    bodies_ = ImmersedBodies(run, shapes);
    gravity_ = run.gravity;
    motion_.grains = grains;
    return motion_;
}

void ScriptedGrains::touch_floor(GrainState& grain, double mass, double step) {
    const double gap = grain.position[1] - grain.radius - floor_;
    // u_n + g/dt >= 0 with the full dt: the grain ends the window on the floor and not in it.
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
    contact.point = {grain.position[0], grain.position[1] - grain.radius, grain.position[2]};
    contact.normal = {0.0, 1.0, 0.0};
    contact.branch = {0.0, grain.radius, 0.0};
    contact.impulse = grain.contact_impulse;
    contacts_.push_back(contact);
}

Motion ScriptedGrains::advance(const Window& window, const std::vector<FreeResponse>& responses) {
    reach("advance", window.index);
    std::unordered_map<GrainId, const FreeResponse*> by_id;
    for (const FreeResponse& response : responses) by_id[response.id] = &response;
    answered_ = !responses.empty();
    motion_.report = {};
    motion_.report.iterations = 1;
    motion_.contacts.reset();
    contacts_.clear();
    contact_velocities_.clear();
    for (GrainState& grain : motion_.grains) {
        const ImmersedBody body = bodies_(grain);
        double mass = body.effective_mass;
        if (answered_) {
            const FreeResponse& response = *by_id.at(grain.id);
            grain.velocity = response.velocity;
            grain.angular_velocity = response.angular_velocity;
            // The fluid's inertia along y, the floor's normal.
            mass = response.inertia[upper_entry(1, 1)];
        } else if (!grain.prescribed) {
            // (M - m_f) g over the effective mass.
            grain.velocity[1] -= body.submerged_mass / mass * gravity_ * window.step;
        }
        if (!grain.prescribed) touch_floor(grain, mass, window.step);
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
        // With responses grains move with their contact velocities, which keep out of the floor
        // (`joint`).
        const Vec3& carrier = answered_ ? contact_velocities_[i] : grain.velocity;
        grain.position = grain.position + window.step * carrier;
        grain.orientation = rotated(grain.orientation, window.step * grain.angular_velocity);
        const double overlap = floor_ - (grain.position[1] - grain.radius);
        motion_.report.max_penetration = std::max(motion_.report.max_penetration, overlap);
    }
    if (window.write_output) motion_.contacts = contacts_;
    return motion_;
}

SavedState ScriptedGrains::save() const {
    reach("save", -1);
    return encode(motion_);
}
void ScriptedGrains::restore(const SavedState& state) {
    reach("restore", -1);
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
    hello.dimension = both_dimensions;
    hello.capabilities.shapes = {"disc", "sphere"};
    hello.capabilities.effective_inertia = true;
    hello.capabilities.saves_state = true;
    hello.capabilities.serialises_state = true;
    return hello;
}

Box ScriptedFluid::initialise(const Settings& settings, const ShapeTable& shapes) {
    reach("initialise", -1);
    const RunValues run = run_values(settings);
    bodies_ = ImmersedBodies(run, shapes);
    gravity_ = run.gravity;
    const double slice = run.size[0] / ranks_;
    box_ = {{rank_ * slice, -everywhere, -everywhere},
            {(rank_ + 1) * slice, everywhere, everywhere}};
    // The outermost slices have no end: every centre has an owner, also beyond the sides.
    if (rank_ == 0) box_.lower[0] = -everywhere;
    if (rank_ + 1 == ranks_) box_.upper[0] = everywhere;
    return box_;
}

bool ScriptedFluid::owns(const GrainState& grain) const {
    return grain.position[0] >= box_.lower[0] && grain.position[0] < box_.upper[0];
}

void ScriptedFluid::advance(const Window& window) {
    reach("advance", window.index);
    grains_.clear();
}

ScriptedFluid::DraggedGrain ScriptedFluid::dragged(const GrainState& grain, double step,
                                                   const Vec3& impulse) const {
    const ImmersedBody body = bodies_(grain);
    DraggedGrain motion;
    motion.id = grain.id;
    motion.prescribed = grain.prescribed;
    // A = M_eff + gamma dt
    motion.mass = body.effective_mass + drag_ * step;
    motion.inertia = body.effective_inertia(2, 2);
    // (M_eff + gamma dt) U = M_eff U^n + J
    const Vec3 coasting = body.effective_mass / motion.mass * grain.velocity;
    motion.velocity = grain.prescribed ? grain.velocity : coasting + 1.0 / motion.mass * impulse;
    motion.angular_velocity = grain.angular_velocity;
    return motion;
}

void ScriptedFluid::let_fall(const Window& window, const std::vector<GrainState>& grains) {
    reach("let_fall", window.index);
    for (const GrainState& grain : grains) {
        if (!owns(grain)) continue;
        const double weight = bodies_(grain).submerged_mass * gravity_;
        grains_.push_back(dragged(grain, window.step, {0.0, -weight * window.step, 0.0}));
    }
}

void ScriptedFluid::correct(const Window& window, const std::vector<GrainState>& grains) {
    reach("correct", window.index);
    // `split`: nothing was let fall in this window.
    const bool first = grains_.empty();
    std::size_t at = 0;
    for (const GrainState& grain : grains) {
        if (!owns(grain)) continue;
        if (first) {
            // What the grain already has of the fluid's impulse is taken back: - J_h.
            grains_.push_back(dragged(grain, window.step, -grain.announced_impulse));
            grains_.back().angular_velocity =
                grain.angular_velocity -
                1.0 / grains_.back().inertia * grain.announced_angular_impulse;
            grains_.back().pushed = grain.contact_impulse;
            grains_.back().angular_pushed = grain.contact_angular_impulse;
        }
        // They must come in the same order each time: the place alone says which is which.
        push(grains_.at(at++), grain);
    }
}

/// The change of the contact impulses, and the error of the contact solve.
void ScriptedFluid::push(DraggedGrain& own, const GrainState& solved) {
    if (own.prescribed) return;
    const Vec3 change = solved.contact_impulse - own.pushed;
    const Vec3 turn = solved.contact_angular_impulse - own.angular_pushed;
    own.velocity = own.velocity + 1.0 / own.mass * change;
    own.angular_velocity = own.angular_velocity + 1.0 / own.inertia * turn;
    own.pushed = solved.contact_impulse;
    own.angular_pushed = solved.contact_angular_impulse;
    own.mismatch = norm(own.velocity - solved.velocity) +
                   solved.radius * norm(own.angular_velocity - solved.angular_velocity);
}

FreeResponse ScriptedFluid::response(const DraggedGrain& grain) const {
    const double mass = response_factor_ * grain.mass, inertia = response_factor_ * grain.inertia;
    FreeResponse response;
    response.id = grain.id;
    if (grain.prescribed) {
        response.velocity = grain.velocity;
        response.angular_velocity = grain.angular_velocity;
        return response;
    }
    // U' - A^-1 J with the inertia that is sent, right or misjudged: so the rounds converge to the
    // true answer either way.
    response.velocity = grain.velocity - 1.0 / mass * grain.pushed;
    response.angular_velocity = grain.angular_velocity - 1.0 / inertia * grain.angular_pushed;
    for (std::size_t i = 0; i < 6; ++i)
        response.inertia[upper_entry(i, i)] = i < 3 ? mass : inertia;
    response.mismatch = grain.mismatch;
    return response;
}

std::vector<FreeResponse> ScriptedFluid::respond() {
    std::vector<FreeResponse> responses;
    for (const DraggedGrain& grain : grains_) responses.push_back(response(grain));
    return responses;
}

Kicks ScriptedFluid::impose(const Window& window) {
    reach("impose", window.index);
    Kicks answer;
    for (const DraggedGrain& grain : grains_) {
        Kick kick;
        kick.id = grain.id;
        kick.velocity = grain.velocity;
        kick.angular_velocity = grain.angular_velocity;
        kick.multiplier_impulse = Vec3{} - drag_ * window.step * kick.velocity;  // 0, not -0
        answer.kicks.push_back(kick);
    }
    return answer;
}

SavedState ScriptedFluid::save() const {
    return {};
}
void ScriptedFluid::restore(const SavedState&) {}

}  // namespace turbidite
