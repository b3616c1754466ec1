// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/uzawa_cg.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite {
namespace {

/// Below this share of u_c a slip is rounding, and there is nothing to solve.
constexpr double rounding = 1e-13;

double target(const MultiplierSettings& settings, double first_rms) {
    const double wanted =
        std::min(settings.tolerance * settings.velocity_scale, settings.reduction * first_rms);
    return std::max(wanted, rounding * settings.velocity_scale);
}

}  // namespace

void MultiplierWorkspace::resize(int rows) {
    for (std::vector<double>* vector : {&impulses, &residual, &direction, &image})
        vector->resize(rows);
}

MultiplierResult uzawa_cg(SaddlePoint& system, const MultiplierSettings& settings,
                          MultiplierWorkspace& work) {
    const int rows = system.rows();
    work.resize(rows);
    double* L = work.impulses.data();
    double* r = work.residual.data();
    double* w = work.direction.data();
    double* y = work.image.data();

    std::fill(L, L + rows, 0.0);
    system.initial_slip(r);  // r = s
    std::copy(r, r + rows, w);
    const double points = std::max(1.0, system.points_everywhere());
    double rr = system.dot(r, r);
    const double goal = target(settings, std::sqrt(rr / points));

    MultiplierResult result;
    while (std::sqrt(rr / points) > goal && result.iterations < settings.iterations) {
        system.apply(w, y);
        const double alpha = rr / system.dot(w, y);
        for (int i = 0; i < rows; ++i) {
            L[i] += alpha * w[i];
            r[i] -= alpha * y[i];
        }
        const double rr_new = system.dot(r, r);
        const double beta = rr_new / rr;
        for (int i = 0; i < rows; ++i) w[i] = r[i] + beta * w[i];
        rr = rr_new;
        ++result.iterations;
    }
    system.impose(L);
    result.residual = std::sqrt(rr / points);
    result.converged = result.residual <= goal;
    return result;
}

}  // namespace turbidite
