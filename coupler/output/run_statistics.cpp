// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/run_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupler/protocol/largest.hpp"

namespace turbidite {
namespace {

std::string contact_sentence(const RunStatistics& s, const Settings& settings) {
    return fmt::format(
        "in {} of {} windows the contact solver used up its {} sweeps (contact.iterations) before "
        "contact.tolerance = {}; residual up to {:.1e}. Allow more sweeps.",
        s.maxima.unconverged_windows, s.windows_done, settings.text("contact.iterations"),
        settings.text("contact.tolerance"), s.contact_residuals.largest());
}

std::string multiplier_sentence(const RunStatistics& s, const Settings& settings) {
    return fmt::format(
        "in {} of {} windows the multiplier problem used up its {} iterations "
        "(fluid.multiplier_iterations); rms slip up to {:.1e} u_c, {} demanded. Allow more "
        "iterations, or a larger fluid.multiplier_tolerance.",
        s.maxima.fluid->unconverged_windows, s.windows_done,
        settings.text("fluid.multiplier_iterations"), s.maxima.fluid->slip,
        settings.text("run.slip_tolerance"));
}

std::string joint_sentence(const RunStatistics& s, const Settings& settings) {
    return fmt::format(
        "in {} of {} windows contacts and fluid differ by more than coupling.tolerance = {} u_c "
        "after coupling.iterations = {} rounds, at most by {:.1e} u_c. Allow more rounds.",
        s.maxima.joint->unconverged_windows, s.windows_done, settings.text("coupling.tolerance"),
        settings.text("coupling.iterations"), s.maxima.joint->mismatch);
}

}  // namespace

void SinceRow::take_in(const WallTimes& spent, bool converged) {
    ++windows;
    unconverged += converged ? 0 : 1;
    wall.step += spent.step;
    wall.fluid += spent.fluid;
    wall.grains += spent.grains;
    wall.coupling += spent.coupling;
}

void ContactResiduals::take_in(const ContactReport& report) {
    if (!report.residual) return;
    const bool worst = std::isnan(*report.residual);  // which has no place in an order
    values_.push_back(worst ? INFINITY : *report.residual);
}

double ContactResiduals::largest() const {
    return values_.empty() ? 0.0 : *std::max_element(values_.begin(), values_.end());
}

double ContactResiduals::quantile(double share) const {
    if (values_.empty()) return 0.0;
    std::vector<double> sorted = values_;
    const auto rank =
        static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(sorted.size()))) - 1;
    const auto at = sorted.begin() + std::max<std::ptrdiff_t>(rank, 0);
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at;
}

RunStatistics::RunStatistics(const Settings& settings)
    : diameter_(settings.real("run.diameter")), velocity_(settings.real("run.velocity_scale")) {
    if (settings.flag("fluid.enabled")) maxima.fluid.emplace();
}

void RunStatistics::take_in(const WindowResult& result) {
    ++windows_done;
    maxima.penetration =
        std::max(maxima.penetration, result.state.report.max_penetration / diameter_);
    maxima.grain_balance = std::max(maxima.grain_balance, result.grain_balance.value_or(0.0));
    maxima.unconverged_windows += result.motion.report.converged ? 0 : 1;
    contact_residuals.take_in(result.motion.report);
    if (maxima.fluid) take_in(result.kicks.report);
    if (result.joint) take_in(*result.joint);
}

void RunStatistics::take_in(const FluidReport& report) {
    FluidMaxima& fluid = *maxima.fluid;
    const double rate = velocity_ / diameter_;  // u_c/D [1/s]
    fluid.divergence = std::max(fluid.divergence, report.divergence / rate);
    fluid.final_divergence = std::max(fluid.final_divergence, report.final_divergence / rate);
    fluid.courant = std::max(fluid.courant, report.courant);
    fluid.balance = std::max(fluid.balance, report.momentum_defect);
    fluid.slip = std::max(fluid.slip, report.multiplier_residual / velocity_);
    fluid.unconverged_windows += report.multipliers_converged ? 0 : 1;
}

void RunStatistics::take_in(const JointReport& report) {
    if (!maxima.joint) maxima.joint.emplace();
    JointMaxima& joint = *maxima.joint;
    joint.rounds = std::max(joint.rounds, report.rounds);
    joint.mismatch = largest(joint.mismatch, report.mismatch / velocity_);
    joint.unconverged_windows += report.converged ? 0 : 1;
}

std::vector<std::string> unconverged_sentences(const RunStatistics& statistics,
                                               const Settings& settings) {
    const RunMaxima& maxima = statistics.maxima;
    std::vector<std::string> sentences;
    if (maxima.unconverged_windows > 0) sentences.push_back(contact_sentence(statistics, settings));
    if (maxima.fluid && maxima.fluid->unconverged_windows > 0)
        sentences.push_back(multiplier_sentence(statistics, settings));
    if (maxima.joint && maxima.joint->unconverged_windows > 0)
        sentences.push_back(joint_sentence(statistics, settings));
    return sentences;
}

}  // namespace turbidite
