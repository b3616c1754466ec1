// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The sides of the domain, four in the plane and six in space, as seen by a grains adapter:
//
//     wall     a flat wall with the surface of the grains; a centre beyond it ends the run
//     inflow   the same: fluid enters through a porous plate at rest, on which grains may lie
//     free     grains whose centre is more than R past the side are removed and counted
//     cyclic   positions wrap, and the minimum image is used
//
// The domain is [0, run.size_x] x [0, run.size_y], in space x [0, run.size_z].
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "coupler/protocol/settings.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"

namespace turbidite {

enum class BorderKind { wall, free, cyclic };

/// One side of the domain: name, type, and the half-plane or half-space with the inward normal.
struct Border {
    std::string name;  ///< "left"
    BorderKind side = BorderKind::wall;
    nscd::Wall plane;
};

/// The sides of coupler/protocol/scene/sides.hpp, from domain.* and run.*; of the material
/// run.side_material.
/// Throws std::invalid_argument for an unknown type of side, or a cyclic side whose opposite is not
/// cyclic.
std::vector<Border> lay_borders(const Settings& settings);

/// Those sides that are walls.
std::vector<nscd::Wall> walls_of(const std::vector<Border>& borders);

/// Throws PhysicsRefused naming a grain whose velocity is not finite; `when` ends the sentence ("in
/// window 3").
void check_velocities(const nscd::Bodies& bodies, const std::string& when);

/// What keeps a free grain from passing a wall, as contact dynamics has it.
inline constexpr const char* shorter_steps = "use a smaller time.step";

/// The same for a position that is not finite, or a centre beyond a wall; `remedy` is for a free
/// grain there.
void check_places(const nscd::Bodies& bodies, const std::vector<Border>& borders,
                  const std::string& when, const char* remedy = shorter_steps);

/// Both checks.
void check_inside(const nscd::Bodies& bodies, const std::vector<Border>& borders,
                  const std::string& when, const char* remedy = shorter_steps);

/// Zero for every body that has left through a free side, one for all others.
std::vector<std::uint8_t> those_inside(const nscd::Bodies& bodies,
                                       const std::vector<Border>& borders);

}  // namespace turbidite
