// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/grains/case_bodies.hpp"

#include <stdexcept>
#include <unordered_set>

#include "coupler/shapes/immersed_bodies.hpp"
#include "granular_adapter/grains/by_grain.hpp"

namespace turbidite {
namespace {

std::string grain(GrainId id) {
    return "grain " + std::to_string(id);
}

bool denser_than_the_fluid(const ImmersedBody& body) {
    return body.effective_mass > 0.0 && body.effective_inertia(2, 2) > 0.0;
}

/// A grain with the inertia and weight of step 4: effective inertia, submerged weight. A grain that
/// is not denser than the fluid gets its own inertia, which is not used: it moves with the one that
/// the fluid's response gives.
nscd::Body immersed(const GrainState& grain, const ImmersedBody& inertia) {
    nscd::Body body;
    body.id = grain.id;
    body.shape = grain.shape;
    body.material = grain.material;
    body.fixed = grain.prescribed;
    body.radius = grain.radius;
    body.density = grain.density;
    const bool sinks = denser_than_the_fluid(inertia);
    body.mass = sinks ? inertia.effective_mass : inertia.mass;
    // The moment about z is the only one in the plane, and that about any axis of a sphere.
    body.inertia = sinks ? inertia.effective_inertia(2, 2) : inertia.inertia(2, 2);
    body.weight_mass = inertia.submerged_mass;
    body.position = grain.position;
    body.orientation = grain.orientation;
    body.twist = twist_of(grain);
    return body;
}

void check_grain(const GrainState& state, const ShapeTable& shapes,
                 std::unordered_set<GrainId>& seen) {
    if (!seen.insert(state.id).second)
        throw std::runtime_error(grain(state.id) + " occurs twice; ids must be unique");
    if (state.shape < 0 || state.shape >= static_cast<std::int32_t>(shapes.size()))
        throw std::runtime_error(grain(state.id) + " has shape " + std::to_string(state.shape) +
                                 " but the table has " + std::to_string(shapes.size()));
}

}  // namespace

void add_grains(nscd::Bodies& bodies, const RunValues& run, const ShapeTable& shapes,
                const std::vector<GrainState>& grains) {
    const ImmersedBodies inertia(run, shapes);
    std::unordered_set<GrainId> seen;
    for (const GrainState& state : grains) {
        check_grain(state, shapes, seen);
        bodies.add(immersed(state, inertia(state)));
    }
}

std::optional<GrainId> first_light_grain(const RunValues& run, const ShapeTable& shapes,
                                         const std::vector<GrainState>& grains) {
    const ImmersedBodies inertia(run, shapes);
    for (const GrainState& state : grains)
        if (!state.prescribed && !denser_than_the_fluid(inertia(state))) return state.id;
    return std::nullopt;
}

void refuse_light_grain(GrainId id) {
    throw std::runtime_error(grain(id) +
                             " is not denser than what the fluid sees of it: without the fluid's "
                             "responses nothing gives it an inertia; use coupling.scheme: joint");
}

std::vector<GrainState> grain_states(const nscd::Bodies& bodies) {
    std::vector<GrainState> states(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        GrainState& state = states[i];
        state.id = bodies.id[i];
        state.shape = bodies.shape[i];
        state.material = bodies.material[i];
        state.prescribed = bodies.fixed[i] != 0;
        state.radius = bodies.radius[i];
        state.density = bodies.density[i];
        state.position = bodies.position[i];
        state.orientation = bodies.orientation[i];
        state.velocity = bodies.twist[i].velocity;
        state.angular_velocity = bodies.twist[i].spin;
        state.contact_impulse = bodies.contact_impulse[i];
        state.contact_angular_impulse = bodies.contact_angular_impulse[i];
    }
    return states;
}

void take_velocities(nscd::Bodies& bodies, const std::vector<Kick>& kicks, const std::string& when,
                     int dimension) {
    const auto ordered = by_grain(bodies.id, kicks, "kick", when);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Twist twist = twist_of(*ordered[i]);
        bodies.twist[i] = dimension == 3 ? twist : in_plane(twist);
    }
}

}  // namespace turbidite
