// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A text as the standard input of this process, and of the program that replaces it.
#pragma once

#include <string>

namespace turbidite {

/// Throws Failure (exit code 4) if the system refuses.
void give_standard_input(const std::string& text);

}  // namespace turbidite
