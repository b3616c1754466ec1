// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/plane/mobility.hpp"

namespace turbidite::nscd {

// Sylvester's criterion, then cofactors. The comparisons are false for NaN.
std::optional<PlanarTensor> inverse(const PlanarTensor& m) {
    PlanarTensor result;
    result.xx = m.yy * m.ss - m.ys * m.ys;
    result.yy = m.xx * m.ss - m.xs * m.xs;
    result.ss = m.xx * m.yy - m.xy * m.xy;
    result.xy = m.xs * m.ys - m.xy * m.ss;
    result.xs = m.xy * m.ys - m.xs * m.yy;
    result.ys = m.xy * m.xs - m.ys * m.xx;
    const double determinant = m.xx * result.xx + m.xy * result.xy + m.xs * result.xs;
    if (!(m.xx > 0.0 && result.ss > 0.0 && determinant > 0.0)) return std::nullopt;
    if (m.isotropic()) return PlanarTensor(1.0 / m.xx, 1.0 / m.ss);
    for (double* entry : {&result.xx, &result.yy, &result.ss, &result.xy, &result.xs, &result.ys})
        *entry /= determinant;
    return result;
}

}  // namespace turbidite::nscd
