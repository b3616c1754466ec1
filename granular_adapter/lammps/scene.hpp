// SPDX-License-Identifier: GPL-2.0-or-later
//
// The commands that make LAMMPS' granular package a scene of discs between walls, with the contact
// law of docs/md.md: linear spring and dashpot without attraction, tangential ones a third as
// strong, Coulomb friction.
#pragma once

#include <string>
#include <vector>

#include "coupler/protocol/settings.hpp"
#include "granular_adapter/grains/borders.hpp"
#include "granular_adapter/lammps/lammps_library.hpp"
#include "granular_adapter/lammps/mass_classes.hpp"

namespace turbidite::lammps {

/// The parameters of a contact (launcher/case/soft_contact.hpp).
struct SoftLaw {
    explicit SoftLaw(const Settings& settings);

    double frequency;  ///< w [1/s]
    double damping;    ///< zeta
    double friction;   ///< mu
};

/// The fix that calls the host in every sub-step, after all contact forces.
extern const char* const loads_fix;

/// The box of the domain, which grows with the grains that leave it, divided among the ranks into
/// strips along x.
void declare_box(Library& lammps, double width, double height, std::size_t types);

/// What grains carry from rank to rank (discs.hpp).
void declare_properties(Library& lammps);

/// Contacts, walls, integration; `skin` is the distance up to which pairs are neighbours [m].
void declare_engines(Library& lammps, const SoftLaw& law, const MassClasses& classes,
                     const std::vector<Border>& borders, double skin);

/// The fixes of all walls, one per class and axis.
std::vector<std::string> wall_fixes(const MassClasses& classes, const std::vector<Border>& borders);

}  // namespace turbidite::lammps
