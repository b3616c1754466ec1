// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/scene/space_walls.hpp"

#include <sstream>
#include <stdexcept>
#include <string>

#include "coupler/protocol/number_text.hpp"
#include "coupler/protocol/scene/plates.hpp"

namespace turbidite {
namespace {

constexpr std::size_t numbers_per_wall = 23;  // after id and kind

[[noreturn]] void refuse(const std::string& text, const std::string& fault) {
    throw std::invalid_argument("run.walls: \"" + text + "\" " + fault);
}

std::vector<double> numbers_of(const std::string& text, std::istringstream& words) {
    std::vector<double> numbers;
    try {
        numbers = remaining_numbers(words);
    } catch (const std::invalid_argument& fault) {
        refuse(text, fault.what());
    }
    if (numbers.size() != numbers_per_wall)
        refuse(text, "has " + std::to_string(numbers.size()) + " numbers after its kind, not " +
                         std::to_string(numbers_per_wall));
    return numbers;
}

SpaceWallKind kind_of(const std::string& text, const std::string& name) {
    for (const SpaceWallName& entry : space_wall_names())
        if (name == entry.name) return entry.kind;
    refuse(text, "is of the unknown kind \"" + name + "\"");
}

SpaceWall wall_of(const std::string& text, std::int32_t key) {
    std::istringstream words(text);
    std::string id, kind;
    words >> id >> kind;
    SpaceWall wall;
    wall.key = key;
    wall.id = number_of<GrainId>(id).value_or(0);
    wall.kind = kind_of(text, kind);
    // The order of the header, from X on: id and kind have been read.
    const std::vector<double> n = numbers_of(text, words);
    const auto vector = [&n](std::size_t i) { return Vec3{n[i], n[i + 1], n[i + 2]}; };
    wall.place = vector(0);
    wall.a = vector(3);
    wall.b = vector(6);
    wall.radius = n[9];
    wall.radius2 = n[10];
    wall.thickness = n[11];
    wall.motion = constant_motion({vector(12), vector(15)});
    wall.pivot = vector(18);
    wall.friction = n[21];
    wall.material = static_cast<std::int32_t>(n[22]);
    return wall;
}

}  // namespace

const std::vector<SpaceWallName>& space_wall_names() {
    static const std::vector<SpaceWallName> names = {{"plate", SpaceWallKind::plate},
                                                     {"cylinder", SpaceWallKind::cylinder},
                                                     {"cone", SpaceWallKind::cone},
                                                     {"ring", SpaceWallKind::ring}};
    return names;
}

std::vector<SpaceWall> space_walls_of(const Settings& settings) {
    std::vector<SpaceWall> walls;
    if (!settings.has("run.walls")) return walls;
    std::istringstream list(settings.text("run.walls"));
    // Walls have the keys after the six sides of the box, in the order of the text.
    const std::int32_t first = first_plate(3);
    std::int32_t key = first;
    for (std::string text; std::getline(list, text, ';');) walls.push_back(wall_of(text, key++));
    for (const Moved& moved : motions_of(settings, "run.wall_motions"))
        if (const auto at = moved.what - first;
            at >= 0 && at < static_cast<std::int64_t>(walls.size()))
            walls[static_cast<std::size_t>(at)].motion = moved.motion;
    return walls;
}

}  // namespace turbidite
