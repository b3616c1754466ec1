// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/constraint_operator.hpp"

namespace turbidite {

void ConstraintOperator::apply(const double* ux, const double* uy, const Planar* motions,
                               double* out) const {
    double* out_x = out;
    double* out_y = out + points_.size();
    for (int g = 0; g < points_.grains(); ++g) {
        const Planar& motion = motions[g];
        for (int p = points_.begin[g]; p < points_.begin[g + 1]; ++p) {
            double x = -(motion.x() - motion.z() * points_.arm_y[p]);
            double y = -(motion.y() + motion.z() * points_.arm_x[p]);
            for (int s = points_.stencil[p]; s < points_.stencil[p + 1]; ++s) {
                x += points_.weight[s] * ux[points_.cell[s]];
                y += points_.weight[s] * uy[points_.cell[s]];
            }
            out_x[p] = x;
            out_y[p] = y;
        }
    }
}

void ConstraintOperator::spread(const double* values, double* fx, double* fy) const {
    const double* values_x = values;
    const double* values_y = values + points_.size();
    for (int p = 0; p < points_.size(); ++p)
        for (int s = points_.stencil[p]; s < points_.stencil[p + 1]; ++s) {
            fx[points_.cell[s]] += points_.weight[s] * values_x[p];
            fy[points_.cell[s]] += points_.weight[s] * values_y[p];
        }
}

void ConstraintOperator::sum_by_grain(const double* values, Planar* out) const {
    const double* values_x = values;
    const double* values_y = values + points_.size();
    for (int g = 0; g < points_.grains(); ++g) {
        double x = 0.0, y = 0.0, moment = 0.0;
        for (int p = points_.begin[g]; p < points_.begin[g + 1]; ++p) {
            x += values_x[p];
            y += values_y[p];
            moment += points_.arm_x[p] * values_y[p] - points_.arm_y[p] * values_x[p];
        }
        out[g] = Planar(x, y, moment);
    }
}

}  // namespace turbidite
