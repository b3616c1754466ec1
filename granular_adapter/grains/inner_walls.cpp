// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/grains/inner_walls.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "granular_adapter/nscd/problem/vec3.hpp"

namespace turbidite {
namespace {

constexpr std::size_t numbers_per_wall = 11;
using Numbers = std::array<double, numbers_per_wall>;

/// Parses exactly eleven numbers, with strtod, since streams do not read every format that is
/// written.
Numbers numbers_of(const std::string& text) {
    Numbers numbers{};
    const char* at = text.c_str();
    for (double& number : numbers) {
        char* end = nullptr;
        number = std::strtod(at, &end);
        if (end == at)
            throw std::invalid_argument("run.walls: \"" + text + "\" has fewer than 11 numbers");
        at = end;
    }
    if (*at != '\0')
        throw std::invalid_argument("run.walls: \"" + text + "\" has more than 11 numbers");
    return numbers;
}

nscd::Wall wall_of(const Numbers& n, std::int32_t key) {
    using namespace nscd;
    const Vec3 from{n[1], n[2], 0.0}, along = Vec3{n[3], n[4], 0.0} - from;
    const double length = norm(along);
    Wall wall;
    wall.point = from + 0.5 * along;
    wall.normal = {-along[1] / length, along[0] / length, 0.0};
    wall.half_length = 0.5 * length;
    wall.velocity = {n[5], n[6], 0.0};
    wall.spin = n[7];
    wall.pivot = {n[8], n[9], 0.0};
    wall.friction = n[10];
    wall.key = key;
    return wall;
}

}  // namespace

std::vector<nscd::Wall> inner_walls(const Settings& settings, std::int32_t first_key) {
    std::vector<nscd::Wall> walls;
    if (!settings.has("run.walls")) return walls;
    std::istringstream list(settings.text("run.walls"));
    for (std::string text; std::getline(list, text, ';');)
        walls.push_back(wall_of(numbers_of(text), first_key++));
    return walls;
}

}  // namespace turbidite
