// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// The sides of the box, in the order of their keys: the only table of them. A side lies across an
/// axis, at 0 (its inward normal points along the axis) or at the size of the box (against it).
/// Opposite sides follow each other. The plane has the first four. Valid C++17.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "coupler/protocol/settings.hpp"
#include "coupler/rigid/vec3.hpp"

namespace turbidite {

/// One side of the box.
struct BoxSide {
    const char* name;
    const char* key;  ///< its type: wall, free, cyclic or inflow
    int axis;
    double inward;  ///< sign of the inward normal along the axis

    /// Of a place in a box of this size, negative beyond the side.
    template <class Size>
    double distance(const Vec3& place, const Size& size) const {
        return inward > 0.0 ? place[axis] : size[axis] - place[axis];
    }
};

/// All of them: left, right, bottom, top, in space front and back.
inline constexpr std::array<BoxSide, 6> box_sides = {{
    {"left", "domain.left", 0, 1.0},
    {"right", "domain.right", 0, -1.0},
    {"bottom", "domain.bottom", 1, 1.0},
    {"top", "domain.top", 1, -1.0},
    {"front", "domain.front", 2, 1.0},
    {"back", "domain.back", 2, -1.0},
}};

/// Those of a box in the plane (2) or in space (3): the first ones of box_sides.
constexpr std::size_t side_count(int dimension) {
    return 2 * static_cast<std::size_t>(dimension);
}
/// 4.
inline constexpr std::size_t planar_sides = side_count(2);

/// Whether the plane has it.
constexpr bool is_planar(const BoxSide& side) {
    return side.axis < 2;
}

/// The place in box_sides of the side across.
constexpr std::size_t opposite(std::size_t side) {
    return side ^ 1;
}

/// For grains an inflow is a wall.
inline bool holds_grains(const std::string& type) {
    return type == "wall" || type == "inflow";
}

/// Of the sides of the run's dimension; the others are empty.
using SideTypes = std::array<std::string, box_sides.size()>;

/// run.dimension; 2 where it is missing.
int dimension_of(const Settings& settings);

/// The type of every side. Throws Failure (bad input) naming the keys for an unknown one, or a
/// cyclic side whose opposite is not cyclic.
SideTypes side_types(const Settings& settings);

}  // namespace turbidite
