// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The keys contact.* of a case, each group with what its keys must satisfy together. They stand
// here, below the case file, since a YADE script of the user's own gives the same options.
#pragma once

#include "coupler/keys/rule.hpp"

namespace turbidite {

KeyGroup contact_problem_keys();     ///< friction, solver, tolerances
KeyGroup contact_law_keys();         ///< friction laws, restitution, rolling, adhesion
KeyGroup material_keys();            ///< contact.materials.NAME.*, contact.pairs.FIRST-SECOND.*
KeyGroup molecular_dynamics_keys();  ///< contact.md_*

/// All of them.
KeyTable contact_key_table();

}  // namespace turbidite
