// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/plane/boundary_operator.hpp"

namespace turbidite {

void BoundaryOperator::apply(const PlaneVector* u, const Planar* motions, double* out) const {
    for (int p = 0; p < points_.boundary_points(); ++p) {
        // (B u)_p = sum over the cells of p of weight u_c
        double x = 0.0, y = 0.0;
        for (int s = points_.stencil[p]; s < points_.stencil[p + 1]; ++s) {
            const PlaneVector& at = u[points_.slot[s]];
            x += points_.weight[s] * at.x;
            y += points_.weight[s] * at.y;
        }
        out[2 * p] = x;
        out[2 * p + 1] = y;
    }
    subtract_motion(motions, out);
}

void BoundaryOperator::subtract_motion(const Planar* motions, double* out) const {
    for (int g = 0; g < points_.grains(); ++g) {
        const Planar& motion = motions[g];
        for (int p = points_.boundary_begin[g]; p < points_.boundary_begin[g + 1]; ++p) {
            // (T U)_p = U + omega x r, with omega x r = omega (-r_y, r_x)
            out[2 * p] -= motion.x() - motion.z() * points_.arm_y[p];
            out[2 * p + 1] -= motion.y() + motion.z() * points_.arm_x[p];
        }
    }
}

void BoundaryOperator::spread(const double* values, PlaneVector* f) const {
    for (int p = 0; p < points_.boundary_points(); ++p)
        for (int s = points_.stencil[p]; s < points_.stencil[p + 1]; ++s) {
            // An impulse at a point is divided among its cells by the weights with which B reads
            // them: only so S = B m^-1 B^T + T A^-1 T^T is symmetric.
            PlaneVector& at = f[points_.slot[s]];
            at.x += points_.weight[s] * values[2 * p];
            at.y += points_.weight[s] * values[2 * p + 1];
        }
}

void BoundaryOperator::sum_by_grain(const double* values, Planar* out) const {
    for (int g = 0; g < points_.grains(); ++g) {
        double x = 0.0, y = 0.0, moment = 0.0;
        for (int p = points_.boundary_begin[g]; p < points_.boundary_begin[g + 1]; ++p) {
            const double px = values[2 * p], py = values[2 * p + 1];
            x += px;
            y += py;
            // r x L
            moment += points_.arm_x[p] * py - points_.arm_y[p] * px;
        }
        out[g] = Planar(x, y, moment);
    }
}

}  // namespace turbidite
