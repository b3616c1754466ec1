// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace turbidite {

/// Columns of the terminal at stdout, or of COLUMNS, from 40 to 120; 80 if neither is known.
int terminal_width();

}  // namespace turbidite
