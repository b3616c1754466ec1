// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/ledger.hpp"

#include <fmt/format.h>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

// A projection that leaves more than this [u_c/D] has failed.
constexpr double divergence_limit = 1e-4;

// What may go wrong once, in a window that grains enter violently, has failed when it goes on.
constexpr int windows_until_refused = 3;

/// What lessens overlaps: springs are as stiff as their own keys say, and sub-steps follow.
std::string against_overlap(const std::string& adapter) {
    if (adapter == "yade-md")
        return "Use a smaller contact.md_overlap, or a larger contact.md_stiffness where it is "
               "given.";
    return "Use a smaller time.step, or more contact.iterations.";
}

std::string multiplier_limits(const Settings& settings) {
    return fmt::format("fluid.multiplier_iterations = {}, fluid.multiplier_tolerance = {} u_c",
                       settings.text("fluid.multiplier_iterations"),
                       settings.text("fluid.multiplier_tolerance"));
}

}  // namespace

Ledger::Ledger(const Settings& settings, std::size_t population)
    : population_(population),
      diameter_(settings.real("run.diameter")),
      velocity_(settings.real("run.velocity_scale")),
      penetration_limit_(settings.real("limits.penetration")),
      against_overlap_(against_overlap(settings.text("grains.adapter"))),
      multiplier_limits_(settings.flag("fluid.enabled") ? multiplier_limits(settings) : "") {}

void Ledger::check_start(const Motion& state) const {
    check_count(state);
}

void Ledger::check(const WindowResult& result) {
    removed_ += static_cast<std::size_t>(result.state.report.removed);
    check_count(result.state);
    check_overlap(result.state);
    check_divergence(result.kicks.report);
    check_multipliers(result.kicks.report);
}

void Ledger::check_count(const Motion& state) const {
    if (state.grains.size() + removed_ == population_) return;
    throw PhysicsRefused(fmt::format(
        "{} grains and {} that left through free sides do not make {}: the grains participant lost "
        "or invented some",
        state.grains.size(), removed_, population_));
}

void Ledger::check_overlap(const Motion& state) const {
    const double overlap = state.report.max_penetration / diameter_;
    if (overlap <= penetration_limit_) return;
    throw PhysicsRefused(
        fmt::format("grains overlap by {:.3g} D, limits.penetration = {:.3g} D. {}", overlap,
                    penetration_limit_, against_overlap_));
}

void Ledger::check_divergence(const FluidReport& report) {
    const double divergence = report.divergence * diameter_ / velocity_;
    const bool good = divergence <= divergence_limit;  // false for NaN
    divergent_windows_ = good ? 0 : divergent_windows_ + 1;
    if (divergent_windows_ < windows_until_refused) return;
    throw PhysicsRefused(fmt::format(
        "the projection fails: max |div phi| = {:.3g} u_c/D in {} windows running, {:.0e} allowed. "
        "Use a smaller time.step or fluid.pressure_tolerance.",
        divergence, divergent_windows_, divergence_limit));
}

void Ledger::check_multipliers(const FluidReport& report) {
    stopped_windows_ = report.multipliers_converged ? 0 : stopped_windows_ + 1;
    if (stopped_windows_ < windows_until_refused) return;
    throw PhysicsRefused(fmt::format(
        "the multiplier problem stops at its iteration limit in {} windows running, at a rms slip "
        "of {:.1e} u_c: {}. Allow more iterations or a larger tolerance, or use a smaller "
        "time.step or fluid.hydrodynamic_radius.",
        stopped_windows_, report.multiplier_residual / velocity_, multiplier_limits_));
}

}  // namespace turbidite
