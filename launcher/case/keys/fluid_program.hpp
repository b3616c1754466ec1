// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Which program plays the fluid (fluid.program), what the box program cannot do, and what `auto`
// means: OpenFOAM wherever it is installed and its mesh fits into memory, otherwise the box program
// where the case allows it.
#pragma once

#include <string>
#include <vector>

#include "coupler/keys/rule.hpp"

namespace turbidite {

KeySpec program_key();
std::vector<Rule> program_rules();

/// Puts the program that `auto` means on this machine in its place, once for all that read the
/// settings. Returns a sentence for the user if OpenFOAM cannot play the case here; otherwise
/// empty.
std::string choose_program(Settings& settings);

/// How the box program would play a case in space whose mesh OpenFOAM has no memory for, or why it
/// cannot; empty in the plane.
std::string hint_of_box(const Settings& settings);

}  // namespace turbidite
