// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/measures/run_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/protocol/largest.hpp"

namespace turbidite {
void SinceRow::take_in(const WallTimes& spent, bool converged, const GrainWork& done) {
    ++windows;
    work += done;
    unconverged += converged ? 0 : 1;
    wall.step += spent.step;
    wall.fluid += spent.fluid;
    wall.grains += spent.grains;
    wall.coupling += spent.coupling;
}

void ContactResiduals::take_in(const ContactReport& report) {
    if (!report.residual) return;
    const bool worst = std::isnan(*report.residual);  // NaN cannot be sorted
    values_.push_back(worst ? INFINITY : *report.residual);
}

double ContactResiduals::largest() const {
    return values_.empty() ? 0.0 : *std::max_element(values_.begin(), values_.end());
}

double ContactResiduals::quantile(double share) const {
    if (values_.empty()) return 0.0;
    std::vector<double> sorted = values_;
    // The smallest value with at least this share of all values at or below it.
    const auto rank =
        static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(sorted.size()))) - 1;
    const auto at = sorted.begin() + std::max<std::ptrdiff_t>(rank, 0);
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at;
}

RunStatistics::RunStatistics(const RunValues& run)
    : diameter_(run.diameter), velocity_(run.velocity), output_every_(run.output_every) {
    if (run.wet) maxima.fluid.emplace();
}

void RunStatistics::resume(const RunStatistics& earlier) {
    windows_done = earlier.windows_done;
    maxima = earlier.maxima;
    contact_residuals = earlier.contact_residuals;
}

void RunStatistics::take_in(const WindowResult& result) {
    ++windows_done;
    raise_maxima(result);
    contact_residuals.take_in(result.motion.report);
}

void RunStatistics::raise_maxima(const WindowResult& result) {
    maxima.penetration =
        std::max(maxima.penetration, result.state.report.max_penetration / diameter_);
    if (const auto violation = result.state.report.contact_violation)
        maxima.contact_violation =
            largest(maxima.contact_violation.value_or(0.0), *violation / velocity_);
    if (result.grain_balance)
        maxima.grain_balance = std::max(maxima.grain_balance, result.grain_balance->defect);
    if (result.motion_defect)
        maxima.motion_defect =
            std::max(maxima.motion_defect, result.motion_defect->defect / diameter_);
    maxima.unconverged_windows += result.motion.report.converged ? 0 : 1;
    if (maxima.fluid) take_in(result.kicks.report);
    if (result.joint) take_in(*result.joint);
}

void RunStatistics::take_in(const FluidReport& report) {
    FluidMaxima& fluid = *maxima.fluid;
    const double rate = velocity_ / diameter_;  // u_c/D [1/s]
    fluid.divergence = std::max(fluid.divergence, report.divergence / rate);
    // An output out of turn ends a part of a run; the run in one part does not have it.
    if (windows_done % output_every_ == 0)
        fluid.final_divergence = std::max(fluid.final_divergence, report.final_divergence / rate);
    fluid.courant = std::max(fluid.courant, report.courant);
    fluid.balance = std::max(fluid.balance, report.momentum_defect);
    fluid.slip = std::max(fluid.slip, report.multiplier_residual / velocity_);
    fluid.unconverged_windows += report.multipliers_converged ? 0 : 1;
    if (!report.splitting) return;
    fluid.remaining_divergence =
        std::max(fluid.remaining_divergence, report.splitting->divergence / rate);
    fluid.unconverged_splitting_windows += report.splitting->converged ? 0 : 1;
}

void RunStatistics::take_in(const JointReport& report) {
    if (!maxima.joint) maxima.joint.emplace();
    JointMaxima& joint = *maxima.joint;
    joint.rounds = std::max(joint.rounds, report.rounds);
    joint.mismatch = largest(joint.mismatch, report.mismatch / velocity_);
    joint.unconverged_windows += report.converged ? 0 : 1;
}

}  // namespace turbidite
