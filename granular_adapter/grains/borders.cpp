// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/grains/borders.hpp"

#include <cstdio>
#include <stdexcept>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/run_values.hpp"
#include "coupler/rigid/vec3.hpp"

namespace turbidite {
namespace {

BorderKind parse_side(const std::string& key, const std::string& text) {
    if (text == "wall" || text == "inflow") return BorderKind::wall;
    if (text == "free") return BorderKind::free;
    if (text == "cyclic") return BorderKind::cyclic;
    throw std::invalid_argument(key + " = \"" + text + "\"; allowed: wall, free, cyclic, inflow");
}

std::string place(const Vec3& x) {
    char text[80];
    std::snprintf(text, sizeof text, "(%.6g, %.6g)", x[0], x[1]);
    return text;
}

std::string named(const nscd::Bodies& bodies, std::size_t i) {
    return "grain " + std::to_string(bodies.id[i]) + " at " + place(bodies.position[i]);
}

[[noreturn]] void refuse_not_a_number(const nscd::Bodies& bodies, std::size_t i,
                                      const std::string& when) {
    throw PhysicsRefused(named(bodies, i) + " has a position or velocity that is not finite, " +
                         when + "; use a smaller time.step");
}

void check_pairs(const std::vector<Border>& borders) {
    for (std::size_t low = 0; low < borders.size(); low += 2)
        if ((borders[low].side == BorderKind::cyclic) !=
            (borders[low + 1].side == BorderKind::cyclic))
            throw std::invalid_argument("domain." + borders[low].name + " and domain." +
                                        borders[low + 1].name + " must both be cyclic, or neither");
}

}  // namespace

std::vector<Border> lay_borders(const Settings& settings) {
    const auto [width, height] = run_values(settings).size;
    std::vector<Border> borders;
    const auto lay = [&](const std::string& name, const Vec3& point, const Vec3& normal) {
        const std::string key = "domain." + name;
        nscd::Wall plane;
        plane.point = point;
        plane.normal = normal;
        plane.material = 0;
        plane.key = static_cast<std::int32_t>(borders.size());
        borders.push_back({name, parse_side(key, settings.text(key)), plane});
    };
    lay("left", {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
    lay("right", {width, 0.0, 0.0}, {-1.0, 0.0, 0.0});
    lay("bottom", {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
    lay("top", {0.0, height, 0.0}, {0.0, -1.0, 0.0});
    check_pairs(borders);
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
                  const std::string& when) {
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (!is_finite(bodies.position[i])) refuse_not_a_number(bodies, i, when);
    for (const Border& border : borders) {
        if (border.side != BorderKind::wall) continue;
        for (std::size_t i = 0; i < bodies.size(); ++i)
            if (signed_distance(border.plane, bodies.position[i]) < 0.0)
                throw PhysicsRefused(named(bodies, i) + " has its centre beyond the " +
                                     border.name + " wall, " + when + "; use a smaller time.step");
    }
}

void check_inside(const nscd::Bodies& bodies, const std::vector<Border>& borders,
                  const std::string& when) {
    check_velocities(bodies, when);
    check_places(bodies, borders, when);
}

std::vector<std::uint8_t> those_inside(const nscd::Bodies& bodies,
                                       const std::vector<Border>& borders) {
    std::vector<std::uint8_t> inside(bodies.size(), 1);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        for (const Border& border : borders)
            if (border.side == BorderKind::free &&
                signed_distance(border.plane, bodies.position[i]) < -bodies.radius[i])
                inside[i] = 0;
    return inside;
}

}  // namespace turbidite
