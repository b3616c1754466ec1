// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/plane/uzawa_cg.hpp"

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

/// a <- keep a + share b.
void change(Multipliers& a, double keep, const Multipliers& b, double share) {
    for (std::size_t i = 0; i < a.values.size(); ++i)
        a.values[i] = keep * a.values[i] + share * b.values[i];
    for (std::size_t g = 0; g < a.on_grains.size(); ++g)
        a.on_grains[g] = keep * a.on_grains[g] + share * b.on_grains[g];
}

}  // namespace

void MultiplierWorkspace::clear(int rows, std::size_t grains) {
    for (Multipliers* vector : {&impulses, &direction, &preconditioned})
        vector->assign_zero(rows, grains);
    image.resize(rows);
}

MultiplierResult uzawa_cg(ConstrainedFlow& flow, const MultiplierSettings& settings,
                          MultiplierWorkspace& work) {
    SaddleOperator& system = flow.system();
    const int rows = system.rows();
    work.clear(rows, system.grains());
    Multipliers &L = work.impulses, &w = work.direction, &z = work.preconditioned;
    double* r = flow.slip().data();
    double* y = work.image.data();

    // Over all ranks, so that all of them take the same number of iterations: each is collective.
    // Without any point the slip is zero, and so is the number of iterations.
    const double points = std::max(1.0, system.points_everywhere());
    double rr = system.dot(r, r), rz = 0.0;
    // rms slip = sqrt(|r|^2 / points), r with both components of every point
    const double goal = target(settings, std::sqrt(rr / points));

    MultiplierResult result;
    while (std::sqrt(rr / points) > goal && result.iterations < settings.iterations) {
        system.precondition(r, z);
        const double rz_new = system.dot(r, z.values.data());
        // beta = r.z / (r.z of the last iteration), alpha = r.z / w.S w
        const double beta = result.iterations == 0 ? 0.0 : rz_new / rz;
        rz = rz_new;
        change(w, beta, z, 1.0);  // w = beta w + z
        system.apply(w, y);
        const double alpha = rz / system.dot(w.values.data(), y);
        change(L, 1.0, w, alpha);  // L += alpha w
        // r = s - S L by recurrence; it is the flow's own slip, from which a push goes on.
        for (int i = 0; i < rows; ++i) r[i] -= alpha * y[i];
        rr = system.dot(r, r);
        ++result.iterations;
    }
    flow.add(L);
    result.residual = std::sqrt(rr / points);
    result.goal = goal;
    result.converged = result.residual <= goal;
    return result;
}

}  // namespace turbidite
