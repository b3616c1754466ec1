// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/participant/scripted.hpp"

#include <limits>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "coupler/protocol/wire.hpp"

namespace turbidite {
namespace {

constexpr double everywhere = std::numeric_limits<double>::max();

// Upper triangle by rows of a 6 x 6 matrix: index of the diagonal entry of row i.
constexpr std::size_t diagonal(std::size_t i) {
    return i * 6 - i * (i - 1) / 2;
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

ScriptedGrains::ScriptedGrains(std::string adapter_name, Fault fault) : fault_(std::move(fault)) {
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
    motion_.grains = grains;
    return motion_;
}

Motion ScriptedGrains::advance(const Window& window, const std::vector<FreeResponse>& responses) {
    reach("advance", window.index);
    std::unordered_map<GrainId, const FreeResponse*> by_id;
    for (const FreeResponse& response : responses) by_id[response.id] = &response;
    for (GrainState& grain : motion_.grains) {
        const ImmersedBody body = bodies_.body(grain);
        grain.velocity[1] -=
            body.submerged_mass / body.effective_mass * bodies_.gravity() * window.step;
        if (!responses.empty()) grain.velocity = by_id.at(grain.id)->velocity;
    }
    return motion_;
}

Motion ScriptedGrains::apply_kick(const Window& window, const std::vector<Kick>& kicks) {
    reach("apply_kick", window.index);
    std::unordered_map<GrainId, const Kick*> by_id;
    for (const Kick& kick : kicks) by_id[kick.id] = &kick;
    for (GrainState& grain : motion_.grains) {
        if (!kicks.empty()) {
            grain.velocity = by_id.at(grain.id)->velocity;
            grain.angular_velocity = by_id.at(grain.id)->angular_velocity;
        }
        for (int i = 0; i < 3; ++i) grain.position[i] += window.step * grain.velocity[i];
    }
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

std::vector<FreeResponse> ScriptedFluid::respond(const Window& window,
                                                 const std::vector<GrainState>& grains) {
    reach("respond", window.index);
    std::vector<FreeResponse> responses;
    for (const GrainState& grain : grains) {
        if (!owns(grain)) continue;
        const ImmersedBody body = bodies_.body(grain);
        const double damped = body.effective_mass + drag_ * window.step;
        FreeResponse response;
        response.id = grain.id;
        for (int i = 0; i < 3; ++i)
            response.velocity[i] = body.effective_mass * grain.velocity[i] / damped;
        response.velocity[1] -= body.submerged_mass * bodies_.gravity() * window.step / damped;
        for (int i = 0; i < 3; ++i) response.inertia[diagonal(i)] = damped;
        for (int i = 3; i < 6; ++i) response.inertia[diagonal(i)] = body.effective_inertia(2, 2);
        responses.push_back(response);
    }
    return responses;
}

std::vector<FreeResponse> ScriptedFluid::correct(const Window& window,
                                                 const std::vector<GrainState>&) {
    reach("correct", window.index);
    throw std::logic_error("the scripted fluid does not correct yet");
}

Kicks ScriptedFluid::impose(const Window& window, const std::vector<GrainState>& grains) {
    reach("impose", window.index);
    Kicks answer;
    for (const GrainState& grain : grains) {
        if (!owns(grain)) continue;
        const ImmersedBody body = bodies_.body(grain);
        const double damping =
            joint_ ? 1.0 : 1.0 / (1.0 + drag_ * window.step / body.effective_mass);
        Kick kick;
        kick.id = grain.id;
        kick.angular_velocity = grain.angular_velocity;
        for (int i = 0; i < 3; ++i) {
            kick.velocity[i] = damping * grain.velocity[i];
            kick.multiplier_impulse[i] = -drag_ * window.step * kick.velocity[i];
        }
        answer.kicks.push_back(kick);
    }
    return answer;
}

SavedState ScriptedFluid::save() const {
    return {};
}
void ScriptedFluid::restore(const SavedState&) {}

}  // namespace turbidite
