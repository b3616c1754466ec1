// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/coupled_step/coupled_step.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace turbidite {
namespace {

/// Adds a correction of which this is the latest.
void add(IterationResult& total, IterationResult latest) {
    // The residual is that of the latest; iterations and breakdowns are those of all.
    latest.iterations += total.iterations;
    latest.broke_down = latest.broke_down || total.broke_down;
    total = latest;
}

// Of pressure, alpha = r.z/(z.A z) of a single iteration is 1 without grains, 1.3 to 1.4 among
// grains that fall, and above 2 where most of r is slow to find, next to a wall that pushes liquid.
// The part that the preconditioner finds exactly is left as 1 - alpha of what it was, with the
// other sign, and velocities would swing from one window to the next. At most 1 nothing changes its
// sign.
constexpr double longest_single_step = 1.0;

}  // namespace

void CoupledStep::exchange_work(std::vector<std::vector<double>>& stages, FaceValues& flux) {
    work_.change.u.swap(stages);
    viscosity_.exchange_residual(flux);
}

/// s without the impulses that it has.
void CoupledStep::keep_transported() {
    if (!keep_) return;
    transported_.resize(box_.components(), box_.size());
    for (int axis = 0; axis < box_.components(); ++axis)
        std::copy_n(step_.velocity(axis), box_.size(), transported_[axis].begin());

    // Transport has added f - dt G p^n (see `begin`); s of another f and p is then s + f - dt G p.
    add_impulses(-1.0, transported_);
}

/// u += sign (f - dt G p)
void CoupledStep::add_impulses(double sign, VelocityRows& u) {
    box_.add_impulses(sign, dt_, step_.pressure(), viscosity_.impulse(), u.pointers());
}

void CoupledStep::place_grains(Constraint& constraint, const std::array<double, 3>& a) {
    // k = 1/(1 + 4 nu dt/h2): what the excess flux of the last window still counts for
    pressure_.begin(constraint, dt_, step_.kept_excess(dt_), a);
}

/// Conjugate directions need W to be symmetric, which it is as far as the slip is reduced: 1e-2 is
/// enough where viscosity reaches less than a cell per window, and stagnates at nu dt/h2 = 3 in the
/// plane.
double CoupledStep::slip_reduction() const {
    constexpr double little_viscosity = 1.6;  // nu dt/h2 = 0.2 in the plane
    return shortest_waves() < little_viscosity ? 1e-2 : 1e-3;
}

/// Of -dt nu L, its largest eigenvalue: 4 nu dt/h2 for each axis.
double CoupledStep::shortest_waves() const {
    const double viscous_number = step_.viscosity() * dt_ / step_.cell_area();  // nu dt/h2
    return 4.0 * box_.components() * viscous_number;
}

bool CoupledStep::one_viscous_iteration_will_do() const {
    // There the correction leaves a twentieth of the shortest waves (below).
    return shortest_waves() <= 0.4;
}

/// The predicted f is explicit in time: it has the shortest waves that many times too strong, of
/// which at most half may remain. One iteration leaves a twentieth up to 0.4, nu dt/h2 = 0.05 in
/// the plane.
IterationLimit CoupledStep::one_viscous_correction(int most) const {
    if (one_viscous_iteration_will_do()) return {1, 0.0, 0.1};
    // A tenth of the residual, or half of the part that they may keep of it where that is less.
    return {most, 0.0, std::min(0.1, 0.5 / shortest_waves())};
}

bool CoupledStep::begins_without_pressure() const {
    const double* p = step_.pressure();
    return std::all_of(p, p + step_.cells(), [](double value) { return value == 0.0; });
}

CoupledReport CoupledStep::correct(RigidGrains& grains, const CoupledLimits& given) {
    CoupledLimits limits = given;
    if (!limits.iterated) {
        limits.viscosity = one_viscous_correction(given.viscosity.most);
        if (limits.pressure.most == 1) limits.pressure.longest_step = longest_single_step;
    }
    // What a direction leaves of its slip adds to the flow's own, which later solves reduce.
    limits.viscosity.slip_reduction = limits.pressure.slip_reduction = slip_reduction();
    // Where a run begins that is a part of the whole velocity, and depends on the number of ranks.
    if (!limits.iterated && limits.pressure.most > 1) limits.pressure.slip_reduction = 1e-6;
    CoupledReport report;
    // Each disturbs the other: solved is what needs no iteration any more.
    // A round ends with pressure, so that u leaves a single one nearly solenoidal.
    while (correct_viscosity(grains, limits, report) && correct_pressure(grains, limits, report))
        if (!limits.iterated) break;
    // One iteration, where that is all that is asked for, need not reach anything.
    const auto met = [](const IterationResult& result, bool to_tolerance) {
        return !result.broke_down && (result.converged || !to_tolerance);
    };
    report.converged = met(report.viscosity, limits.iterated || !one_viscous_iteration_will_do()) &&
                       met(report.pressure, limits.iterated || limits.pressure.most > 1);
    return report;
}

/// False if nothing has changed since the pressure was corrected.
bool CoupledStep::correct_viscosity(RigidGrains& grains, const CoupledLimits& limits,
                                    CoupledReport& report) {
    IterationLimit limit = limits.viscosity;
    // The limit holds for all corrections of this call together.
    limit.most -= report.viscosity.iterations;
    const IterationResult result = viscosity_.correct(box_, grains, limit);
    const bool first = report.corrections++ == 0;
    add(report.viscosity, result);
    return first || result.iterations > 0;
}

/// False if nothing has changed since viscosity was corrected.
bool CoupledStep::correct_pressure(RigidGrains& grains, const CoupledLimits& limits,
                                   CoupledReport& report) {
    IterationLimit limit = limits.pressure;
    limit.most -= report.pressure.iterations;
    const IterationResult result = pressure_.correct(box_, grains, limit);
    add(report.pressure, result);
    // Without `iterated` the slip is removed by the solve after the contacts.
    if (limits.iterated) report.slip = grains.settle();
    return result.iterations > 0;
}

VelocityRows CoupledStep::unconstrained() {
    VelocityRows s = std::exchange(transported_, {});
    add_impulses(1.0, s);
    return s;
}

BoxStep::Force CoupledStep::viscous_force() {
    BoxForce force = viscosity_.sum(box_);
    // sum f V_c/dt
    for (double& component : force) component *= step_.cell_volume() / dt_;
    return force;
}

}  // namespace turbidite
