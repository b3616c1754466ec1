// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/grains/borders.hpp"

#include <cstdio>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/run_values.hpp"
#include "coupler/protocol/scene/sides.hpp"
#include "coupler/rigid/vec3.hpp"

namespace turbidite {
namespace {

BorderKind kind_of(const std::string& type) {
    if (holds_grains(type)) return BorderKind::wall;
    return type == "free" ? BorderKind::free : BorderKind::cyclic;
}

std::string place(const Vec3& x) {
    char text[80];
    if (x[2] == 0.0)
        std::snprintf(text, sizeof text, "(%.6g, %.6g)", x[0], x[1]);
    else
        std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g)", x[0], x[1], x[2]);
    return text;
}

std::string named(const nscd::Bodies& bodies, std::size_t i) {
    return "grain " + std::to_string(bodies.id[i]) + " at " + place(bodies.position[i]);
}

[[noreturn]] void refuse_not_a_number(const nscd::Bodies& bodies, std::size_t i,
                                      const std::string& when) {
    throw PhysicsRefused(named(bodies, i) + " has a position or velocity that is not finite, " +
                         when + "; " + shorter_steps);
}

}  // namespace

std::vector<Border> lay_borders(const Settings& settings) {
    const RunValues run = run_values(settings);
    const SideTypes types = side_types(settings);
    const auto material = static_cast<std::int32_t>(
        settings.has("run.side_material") ? settings.integer("run.side_material") : 0);
    std::vector<Border> borders;
    for (std::size_t i = 0; i < side_count(run.dimension); ++i) {
        const auto& [name, key, axis, inward] = box_sides[i];
        nscd::Wall plane;
        plane.normal = {};
        plane.normal[axis] = inward;
        plane.point[axis] = inward > 0.0 ? 0.0 : run.size[axis];
        plane.material = material;
        // The key is the number of the side in the protocol: 0 left, 1 right, 2 bottom, 3 top, 4
        // front, 5 back.
        plane.key = static_cast<std::int32_t>(i);
        borders.push_back({name, kind_of(types[i]), plane});
    }
    return borders;
}

std::vector<nscd::Wall> walls_of(const std::vector<Border>& borders) {
    std::vector<nscd::Wall> walls;
    for (const Border& border : borders)
        if (border.side == BorderKind::wall) walls.push_back(border.plane);
    return walls;
}

void check_velocities(const nscd::Bodies& bodies, const std::string& when) {
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (!is_finite(bodies.twist[i].velocity) || !is_finite(bodies.twist[i].spin))
            refuse_not_a_number(bodies, i, when);
}

void check_places(const nscd::Bodies& bodies, const std::vector<Border>& borders,
                  const std::string& when, const char* remedy) {
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (!is_finite(bodies.position[i])) refuse_not_a_number(bodies, i, when);
    for (const Border& border : borders) {
        if (border.side != BorderKind::wall) continue;
        for (std::size_t i = 0; i < bodies.size(); ++i)
            if (signed_distance(border.plane, bodies.position[i]) < 0.0)
                throw PhysicsRefused(
                    named(bodies, i) + " has its centre beyond the " + border.name + " wall, " +
                    when + "; " +
                    (bodies.fixed[i] ? "its prescribed motion takes it there" : remedy));
    }
}

void check_inside(const nscd::Bodies& bodies, const std::vector<Border>& borders,
                  const std::string& when, const char* remedy) {
    check_velocities(bodies, when);
    check_places(bodies, borders, when, remedy);
}

std::vector<std::uint8_t> those_inside(const nscd::Bodies& bodies,
                                       const std::vector<Border>& borders) {
    std::vector<std::uint8_t> inside(bodies.size(), 1);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        for (const Border& border : borders)
            // Gone where no part of the grain is left inside.
            if (border.side == BorderKind::free &&
                signed_distance(border.plane, bodies.position[i]) < -bodies.radius[i])
                inside[i] = 0;
    return inside;
}

}  // namespace turbidite
