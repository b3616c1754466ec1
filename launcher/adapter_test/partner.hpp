// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace turbidite {

/// Drag gamma of the scripted fluid [rho_f u_c D per unit length], in runs whose D, u_c and rho_f
/// are 1.
inline constexpr double partner_drag = 0.3;

}  // namespace turbidite
