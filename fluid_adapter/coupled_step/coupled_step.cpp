// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/coupled_step/coupled_step.hpp"

#include <cmath>

namespace turbidite {

void CoupledStep::begin(double dt) {
    dt_ = dt;
    pressure_.begin(box_, dt);
    viscosity_.begin(box_, step_.viscosity() * dt, {step_.velocity(0), step_.velocity(1)});
}

void CoupledStep::predict() {
    double *x = step_.velocity(0), *y = step_.velocity(1);
    if (keep_) {
        transported_.x.assign(x, x + box_.size());
        transported_.y.assign(y, y + box_.size());
    }
    pressure_.predict(box_, viscosity_.impulse(), x, y);
}

void CoupledStep::place_grains(const CollocationPoints& points) {
    pressure_.place_grains(box_, points, step_.kept_excess(dt_));
}

/// Conjugate directions need W to be symmetric, which it is as far as the slip is reduced: 1e-2 is
/// enough where viscosity reaches less than a cell per window, and stagnates at nu dt/h2 = 3.
double CoupledStep::slip_reduction() const {
    constexpr double little_viscosity = 0.2;  // nu dt/h2
    return step_.viscosity() * dt_ < little_viscosity * step_.cell_area() ? 1e-2 : 1e-3;
}

CoupledReport CoupledStep::correct(RigidGrains& grains, const CoupledLimits& given) {
    CoupledLimits limits = given;
    limits.viscosity.slip_reduction = limits.pressure.slip_reduction = slip_reduction();
    CoupledReport report;
    for (bool again = true; again;) {
        IterationLimit viscous = limits.viscosity, pressure = limits.pressure;
        viscous.most -= report.viscosity.iterations;
        pressure.most -= report.pressure.iterations;
        const IterationResult f = viscosity_.correct(box_, grains, viscous);
        const IterationResult p = pressure_.correct(box_, grains, pressure);
        report.add(f, p);
        if (limits.iterated) report.slip = grains.settle();
        // Each disturbs the others: solved is what needs no iteration any more.
        again = limits.iterated && f.iterations + p.iterations > 0;
    }
    return report;
}

void CoupledReport::add(const IterationResult& viscosity_again,
                        const IterationResult& pressure_again) {
    const auto append = [](IterationResult& total, IterationResult latest) {
        latest.iterations += total.iterations;
        latest.broke_down = latest.broke_down || total.broke_down;
        total = latest;
    };
    append(viscosity, viscosity_again);
    append(pressure, pressure_again);
}

RowsOfTwo CoupledStep::unconstrained() {
    RowsOfTwo s = transported_;
    pressure_.predict(box_, viscosity_.impulse(), s.x.data(), s.y.data());
    return s;
}

BoxStep::Force CoupledStep::viscous_force() const {
    const RowsOfTwo& f = viscosity_.impulse();
    const double per_time = step_.cell_area() / dt_;
    return {per_time * box_.sum_of_cells(f.x), per_time * box_.sum_of_cells(f.y)};
}

}  // namespace turbidite
