// SPDX-License-Identifier: GPL-2.0-or-later
//
// The commands that make LAMMPS' granular package a scene of discs, in space of spheres, between
// walls, with the contact law of md/soft_law.hpp.
#pragma once

#include <string>
#include <vector>

#include "coupler/protocol/settings.hpp"
#include "granular_adapter/grains/borders.hpp"
#include "granular_adapter/lammps/lammps_library.hpp"
#include "granular_adapter/lammps/mass_classes.hpp"
#include "granular_adapter/md/soft_law.hpp"
#include "granular_adapter/nscd/problem/periodic_box.hpp"

namespace turbidite::lammps {

/// The fix that calls the host in every sub-step, after all contact forces.
extern const char* const loads_fix;

/// The command that LAMMPS needs before it has a box: one layer of ranks along y and z.
inline constexpr const char* strips_along_x = "processors * 1 1";

/// The box of the domain, which along axes that do not repeat grows with the grains that leave it,
/// divided among the ranks into strips along x. Beyond free sides it reaches by `margin` [m] from
/// the start: its growth is found when LAMMPS looks for neighbours, and a restart file that is read
/// loses the grains outside.
void declare_box(Library& lammps, int dimension, const Vec3& size, const nscd::PeriodicBox& period,
                 const std::vector<Border>& borders, double margin, std::size_t types);

/// What grains carry from rank to rank (round_grains.hpp).
void declare_properties(Library& lammps, int dimension);

struct Engines {
    const SoftLaw& law;
    const MassClasses& classes;
    const std::vector<Border>& borders;
    double skin;  ///< distance up to which pairs are neighbours [m]
    bool in_space;
};

/// Contacts, walls, integration.
void declare_engines(Library& lammps, const Engines& engines);

/// The fixes of all walls, one per class and axis.
std::vector<std::string> wall_fixes(const MassClasses& classes, const std::vector<Border>& borders);

}  // namespace turbidite::lammps
