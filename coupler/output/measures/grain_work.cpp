// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/measures/grain_work.hpp"

#include "coupler/rigid/rigid_motion.hpp"

namespace turbidite {
namespace {

/// Mean velocities of a grain over a window.
struct MeanMotion : Twist {
    bool free = false;
};

}  // namespace

GrainWork& GrainWork::operator+=(const GrainWork& other) {
    contacts += other.contacts;
    fluid += other.fluid;
    films += other.films;
    return *this;
}

GrainWork WorkOnGrains::operator()(const Motion& before, const WindowResult& result, double step) {
    before_.follow(before.grains);
    after_.follow(result.state.grains);
    std::size_t start = GrainIndex::nowhere, end = start;
    const auto motion_of = [&](GrainId id) -> MeanMotion {
        start = before_.place(id, start + 1), end = after_.place(id, end + 1);
        if (start == GrainIndex::nowhere || end == GrainIndex::nowhere) return {};
        const GrainState &from = before.grains[start], &to = result.state.grains[end];
        // (U^n + U^{n+1})/2: with it the work of the impulses is the exact change of kinetic
        // energy.
        return {{0.5 * (from.velocity + to.velocity),
                 0.5 * (from.angular_velocity + to.angular_velocity)},
                !from.prescribed};
    };
    GrainWork work;
    work.films = result.state.report.film_work.value_or(0.0);
    const bool dry = result.motion.grains.empty();  // contacts are then told with the state
    for (const GrainState& grain : dry ? result.state.grains : result.motion.grains)
        if (const MeanMotion m = motion_of(grain.id); m.free)
            // J_c . U + K_c . omega, of the mean velocities
            work.contacts +=
                dot(grain.contact_impulse, m.velocity) + dot(grain.contact_angular_impulse, m.spin);
    for (const Kick& kick : result.kicks.kicks)
        if (const MeanMotion m = motion_of(kick.id); m.free)
            // dt (F_h . U + T_h . omega)
            work.fluid += step * (dot(kick.force, m.velocity) + dot(kick.torque, m.spin));
    return work;
}

}  // namespace turbidite
