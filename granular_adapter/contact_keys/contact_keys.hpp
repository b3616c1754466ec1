// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The keys contact.* of a case, in groups, each with the rules between its keys. They are defined
// here, below the case file, because a user's own YADE script offers the same options.
#pragma once

#include <string>

#include "coupler/keys/rule.hpp"

namespace turbidite {

KeyGroup contact_problem_keys();     ///< friction, solver, tolerances
KeyGroup contact_law_keys();         ///< friction laws, restitution, rolling, adhesion
KeyGroup material_keys();            ///< contact.materials.NAME.*, contact.pairs.FIRST-SECOND.*
KeyGroup molecular_dynamics_keys();  ///< contact.md_*

/// The first key that gives a coefficient above zero, of contact.* or of a material or pair:
/// "contact.materials.steel.rolling_friction". Empty if there is none.
std::string positive_coefficient(const Settings& settings, const std::string& coefficient);

/// grains.shape is a disc or a sphere.
bool shape_is_round(const Settings& settings);

/// What is said of grains with corners; nothing where no key gives a rolling resistance.
Ruling corners_do_not_roll(const Settings& settings);

/// The same; nothing without films of liquid.
Ruling corners_have_no_films(const Settings& settings);

/// Whether contacts have films of liquid, of keys that only a case file has.
bool has_films(const Settings& settings);

/// All groups in one table.
KeyTable contact_key_table();

}  // namespace turbidite
