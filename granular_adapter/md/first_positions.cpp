// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/md/first_positions.hpp"

#include <algorithm>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/engine/engine.hpp"
#include "granular_adapter/nscd/engine/theta_scheme.hpp"

namespace turbidite {
namespace {

// Of a radius: what surfaces that touch are apart.
constexpr double touch = 1e-9;

/// Bodies at rest and of one material, as far as their gaps matter.
nscd::Engine still_engine(const nscd::Bodies& bodies, const RunValues& run,
                          const ShapeTable& shapes, std::vector<nscd::Wall> walls) {
    nscd::EngineSettings settings;
    settings.dimension = run.dimension;
    settings.box.length = run.period;
    settings.friction = 0.0;
    settings.law_settings.recovery_fraction = 0.0;  // nothing to solve: gaps are all that is asked
    for (nscd::Wall& wall : walls) wall.material = -1;
    nscd::Engine engine(settings, shapes, std::move(walls));
    engine.bodies() = bodies;
    std::fill(engine.bodies().twist.begin(), engine.bodies().twist.end(), Twist{});
    std::fill(engine.bodies().material.begin(), engine.bodies().material.end(), 0);
    return engine;
}

/// Marks bodies that their way back has taken into others, with these; whether any was not at q.
bool mark_overlaps(const nscd::Bodies& bodies, nscd::Engine engine,
                   std::vector<std::uint8_t>& stays) {
    engine.step(1.0);
    bool found = false;
    // Against its way back; none where it has been put back
    const auto velocity_at = [&](std::int32_t body, const Vec3& arm) {
        const auto i = static_cast<std::size_t>(body);
        return stays[i] ? Vec3{} : bodies.twist[i].at(arm);
    };
    const auto mark = [&](std::int32_t body) {
        std::uint8_t& stay = stays[static_cast<std::size_t>(body)];
        found = found || stay == 0;
        stay = 1;
    };
    for (const nscd::ContactPoint& point : engine.points()) {
        const auto b = static_cast<std::size_t>(point.b);
        if (point.gap >= -touch * bodies.radius[b]) continue;
        Vec3 apart = velocity_at(point.b, point.arm_b);
        if (point.a >= 0) apart = apart - velocity_at(point.a, point.arm_a);
        // Not the way back has made the overlap: it is one of the case.
        if (dot(point.normal, apart) <= 0.0) continue;
        mark(point.b);
        if (point.a >= 0) mark(point.a);
    }
    return found;
}

}  // namespace

std::vector<std::uint8_t> take_first_positions(nscd::Bodies& bodies, double lead,
                                               const RunValues& run, const ShapeTable& shapes,
                                               const std::vector<nscd::Wall>& walls) {
    std::vector<std::uint8_t> stays(bodies.size(), 0);
    const bool at_rest = std::all_of(bodies.twist.begin(), bodies.twist.end(),
                                     [](const Twist& twist) { return twist.at_rest(); });
    if (at_rest) return stays;
    const nscd::Bodies at_q = bodies;
    nscd::move(bodies, bodies.twist, -lead, {.length = run.period});
    // Who has been put back may be met by others that have not.
    while (mark_overlaps(bodies, still_engine(bodies, run, shapes, walls), stays))
        put_where(stays, at_q, bodies);
    return stays;
}

void put_where(const std::vector<std::uint8_t>& mask, const nscd::Bodies& from, nscd::Bodies& to) {
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (!mask[i]) continue;
        to.position[i] = from.position[i];
        to.orientation[i] = from.orientation[i];
    }
}

double deepest_overlap(const nscd::Bodies& bodies, const RunValues& run, const ShapeTable& shapes,
                       const std::vector<nscd::Wall>& walls) {
    return still_engine(bodies, run, shapes, walls).max_penetration();
}

}  // namespace turbidite
