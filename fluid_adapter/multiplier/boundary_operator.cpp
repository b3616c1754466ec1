// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/boundary_operator.hpp"

namespace turbidite {

void BoundaryOperator::apply(const PlaneVector* u, const Planar* motions, double* out) const {
    double* out_x = out;
    double* out_y = out + points_.boundary_points();
    for (int p = 0; p < points_.boundary_points(); ++p) {
        double x = 0.0, y = 0.0;
        for (int s = points_.stencil[p]; s < points_.stencil[p + 1]; ++s) {
            const PlaneVector& at = u[points_.slot[s]];
            x += points_.weight[s] * at.x;
            y += points_.weight[s] * at.y;
        }
        out_x[p] = x;
        out_y[p] = y;
    }
    subtract_motion(motions, out);
}

void BoundaryOperator::subtract_motion(const Planar* motions, double* out) const {
    double* out_x = out;
    double* out_y = out + points_.boundary_points();
    for (int g = 0; g < points_.grains(); ++g) {
        const Planar& motion = motions[g];
        for (int p = points_.boundary_begin[g]; p < points_.boundary_begin[g + 1]; ++p) {
            out_x[p] -= motion.x() - motion.z() * points_.arm_y[p];
            out_y[p] -= motion.y() + motion.z() * points_.arm_x[p];
        }
    }
}

void BoundaryOperator::spread(const double* values, PlaneVector* f) const {
    const double* values_x = values;
    const double* values_y = values + points_.boundary_points();
    for (int p = 0; p < points_.boundary_points(); ++p)
        for (int s = points_.stencil[p]; s < points_.stencil[p + 1]; ++s) {
            PlaneVector& at = f[points_.slot[s]];
            at.x += points_.weight[s] * values_x[p];
            at.y += points_.weight[s] * values_y[p];
        }
}

void BoundaryOperator::sum_by_grain(const double* values, Planar* out) const {
    const double* values_x = values;
    const double* values_y = values + points_.boundary_points();
    for (int g = 0; g < points_.grains(); ++g) {
        double x = 0.0, y = 0.0, moment = 0.0;
        for (int p = points_.boundary_begin[g]; p < points_.boundary_begin[g + 1]; ++p) {
            x += values_x[p];
            y += values_y[p];
            moment += points_.arm_x[p] * values_y[p] - points_.arm_y[p] * values_x[p];
        }
        out[g] = Planar(x, y, moment);
    }
}

}  // namespace turbidite
