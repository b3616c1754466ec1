// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// What a granular code can do beyond the least that any can, so that a case that asks for more is
/// refused and not played otherwise than it says.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// Beyond free grains of one material that touch without friction and restitution, between walls at
/// rest, on one rank.
struct Abilities {
    bool ranks = false;              ///< grains.ranks above 1
    bool open_sides = false;         ///< sides that are free or cyclic
    bool inner_walls = false;        ///< walls inside the box: run.walls
    bool moving_walls = false;       ///< those with velocities, and run.wall_motions of any wall
    bool given_motions = false;      ///< grains that keep their velocity: GrainState::prescribed
    bool materials = false;          ///< run.materials and run.side_material
    bool friction = false;           ///< contact.friction, and that of materials, pairs and walls
    bool restitution = false;        ///< contact.restitution, and that of materials and pairs
    bool laws = false;               ///< adhesion, rolling and torsion, films, contact.law
    bool contact_positions = false;  ///< coupling.positions: contact
};

/// Why the code must refuse a case, naming the key; empty if it can do what the case asks for.
/// Keys that the case does not have ask for nothing.
std::string beyond(const Abilities& able, const Settings& settings,
                   const std::vector<GrainState>& grains);

/// Of the bits of turbidite_adapter::knows.
Abilities abilities_of(std::uint64_t bits);

}  // namespace turbidite
