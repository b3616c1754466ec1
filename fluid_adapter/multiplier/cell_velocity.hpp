// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace turbidite {

/// Velocity components over the rank's own cells, in the field's arrays and not copied [m/s].
struct CellVelocity {
    double* x;
    double* y;
    double* z = nullptr;  ///< in space
};

}  // namespace turbidite
