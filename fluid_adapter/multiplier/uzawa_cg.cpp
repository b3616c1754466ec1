// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/uzawa_cg.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite {
namespace {

/// A slip below this fraction of u_c is rounding; there is nothing to solve.
constexpr double rounding = 1e-13;

double target(const MultiplierSettings& settings, double first_rms) {
    const double wanted =
        std::min(settings.tolerance * settings.velocity_scale, settings.reduction * first_rms);
    return std::max(wanted, rounding * settings.velocity_scale);
}

}  // namespace

void MultiplierWorkspace::resize(int rows) {
    for (std::vector<double>* vector : {&impulses, &direction, &image, &preconditioned})
        vector->resize(rows);
}

MultiplierResult uzawa_cg(SaddlePoint& system, const MultiplierSettings& settings,
                          MultiplierWorkspace& work) {
    const int rows = system.rows();
    work.resize(rows);
    std::fill(work.impulses.begin(), work.impulses.end(), 0.0);
    std::fill(work.direction.begin(), work.direction.end(), 0.0);
    double* L = work.impulses.data();
    double* r = system.slip().data();
    double* w = work.direction.data();
    double* y = work.image.data();
    double* z = work.preconditioned.data();

    const double points = std::max(1.0, system.points_everywhere());
    double rr = system.dot(r, r), rz = 0.0;
    const double goal = target(settings, std::sqrt(rr / points));

    MultiplierResult result;
    while (std::sqrt(rr / points) > goal && result.iterations < settings.iterations) {
        system.precondition(r, z);  // z = C^-1 r
        const double rz_new = system.dot(r, z);
        const double beta = result.iterations == 0 ? 0.0 : rz_new / rz;
        rz = rz_new;
        for (int i = 0; i < rows; ++i) w[i] = z[i] + beta * w[i];  // w <- z + beta w
        system.apply(w, y);                                        // y = S w
        const double alpha = rz / system.dot(w, y);                // alpha = r z / w S w
        for (int i = 0; i < rows; ++i) {
            L[i] += alpha * w[i];  // L <- L + alpha w
            r[i] -= alpha * y[i];  // r <- r - alpha S w
        }
        rr = system.dot(r, r);
        ++result.iterations;
    }
    system.add(work.impulses);
    result.residual = std::sqrt(rr / points);
    result.goal = goal;
    result.converged = result.residual <= goal;
    return result;
}

}  // namespace turbidite
