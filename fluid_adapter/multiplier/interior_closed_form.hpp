// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Step 5 without iteration when every point is a cell centre: B selects, so the multipliers of a
// grain are eliminated exactly. Per grain, with m = rho_f V_c and sums over its cells,
//
//     cM U45 - J_h + m sum u3          [ cM + m n      0          -m sum r_y    ] [ U_x   ]
//     (x, y and moment)             =  [     0       cM + m n      m sum r_x    ] [ U_y   ]
//                                      [ -m sum r_y   m sum r_x   cI + m sum r2 ] [ omega ]
//
// then u = U + omega x r in its cells and L = m (u3 - u). Well posed whenever cM + m n > 0, so for
// grains of any density. Valid C++17.
#pragma once

#include "fluid_adapter/multiplier/uzawa_cg.hpp"

namespace turbidite {

/// Throws std::invalid_argument when a point is not a cell centre. Nothing is iterated or left
/// over, and the result says so.
MultiplierResult interior_closed_form(SaddlePoint& system, const MultiplierSettings& settings,
                                      MultiplierWorkspace& work);

}  // namespace turbidite
