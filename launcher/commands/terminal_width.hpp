// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace turbidite {

/// Columns of the terminal at stdout, or of COLUMNS, from 40 to 120; 80 if neither is known.
int terminal_width();

/// Lines as they are for a file or a pipe, and in the width of the terminal for a terminal.
std::string for_stdout(const std::string& lines);

}  // namespace turbidite
