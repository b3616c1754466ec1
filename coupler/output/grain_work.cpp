// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/grain_work.hpp"

namespace turbidite {
namespace {

double dot(const Vec3& a, const Vec3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vec3 mean(const Vec3& a, const Vec3& b) {
    return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
}

/// Mean velocities of a grain over a window.
struct MeanMotion {
    Vec3 velocity{}, spin{};
    bool free = false;
};

}  // namespace

GrainWork& GrainWork::operator+=(const GrainWork& other) {
    contacts += other.contacts;
    fluid += other.fluid;
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
        return {mean(from.velocity, to.velocity), mean(from.angular_velocity, to.angular_velocity),
                !from.prescribed};
    };
    GrainWork work;
    const bool dry = result.motion.grains.empty();  // contacts are then told with the state
    for (const GrainState& grain : dry ? result.state.grains : result.motion.grains)
        if (const MeanMotion m = motion_of(grain.id); m.free)
            work.contacts +=
                dot(grain.contact_impulse, m.velocity) + dot(grain.contact_angular_impulse, m.spin);
    for (const Kick& kick : result.kicks.kicks)
        if (const MeanMotion m = motion_of(kick.id); m.free)
            work.fluid += step * (dot(kick.force, m.velocity) + dot(kick.torque, m.spin));
    return work;
}

}  // namespace turbidite
