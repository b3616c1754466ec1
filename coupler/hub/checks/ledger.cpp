// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/checks/ledger.hpp"

#include <fmt/format.h>

#include <utility>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

// A projection that leaves more than this [u_c/D] has failed.
// Velocity gradients of the flow are of order u_c/D: a projection must leave far less.
constexpr double divergence_limit = 1e-4;

// Fewer failures in succession, as in windows with violent motion, are tolerated.
constexpr int windows_until_refused = 3;

/// Advice on reducing overlaps; for springs, their own keys set the stiffness and with it the
/// sub-steps.
std::string against_overlap(const HubSettings& settings) {
    if (settings.users_program)
        return "Use a smaller time.step, or stiffer or better converged contacts in your program.";
    if (settings.springs)
        return "Use a smaller contact.md_overlap, or a larger contact.md_stiffness if it is given.";
    return "Use a smaller time.step, or more contact.iterations.";
}

std::string text(const SolveLimit& limit) {
    return fmt::format("fluid.multiplier_iterations = {}, fluid.multiplier_tolerance = {:g} u_c",
                       limit.iterations, limit.tolerance);
}

}  // namespace

Ledger::Ledger(const HubSettings& settings, Print warn)
    : settings_(settings),
      warn_(std::move(warn)),
      grain_balance_{"grain_balance", settings.grain_balance},
      fluid_balance_{"fluid_balance", settings.fluid_balance} {}

void Ledger::name_programs(std::string grains, std::string fluid) {
    grains_ = std::move(grains);
    fluid_ = std::move(fluid);
}

LedgerState Ledger::saved() const {
    return {divergent_windows_, stopped_windows_, grain_balance_.warned, fluid_balance_.warned};
}

void Ledger::resume(const LedgerState& state) {
    divergent_windows_ = state.divergent_windows;
    stopped_windows_ = state.stopped_windows;
    grain_balance_.warned = state.warned_of_grains;
    fluid_balance_.warned = state.warned_of_fluid;
}

void Ledger::check(const Window& window, const WindowResult& result) {
    check_overlap(window, result.state);
    // Without a fluid the report is an empty one, which passes both.
    check_divergence(result.kicks.report);
    check_multipliers(result.kicks.report);
    if (result.grain_balance)
        judge(grain_balance_, result.grain_balance->defect, window, meaning(*result.grain_balance));
    // The fluid's own account of its momentum: zero without one.
    if (settings_.run.wet)
        judge(
            fluid_balance_, result.kicks.report.momentum_defect, window,
            fmt::format("the momentum of the fluid does not change by the impulses of multipliers "
                        "and boundaries, as reported by {}",
                        fluid_));
}

std::string Ledger::meaning(const GrainBalance& balance) const {
    switch (balance.rule) {
        case GrainBalance::Rule::wet:
            return fmt::format(
                "M dU = (M - m_f) g dt + J_c + F_h dt fails most for grain {}. Contact impulses, "
                "velocities and masses of {} must belong together, and so must the multiplier "
                "impulses and velocities of {}",
                balance.worst, grains_, fluid_);
        case GrainBalance::Rule::dry:
            return fmt::format(
                "M dU = M g dt + J_c fails most for grain {}. Contact impulses, velocities and "
                "masses of {} must belong together",
                balance.worst, grains_);
        case GrainBalance::Rule::state:
            return fmt::format(
                "velocities of the state must be those of the kicks, and its contact impulses "
                "those of the motion; grain {} of {} is farthest from it",
                balance.worst, grains_);
    }
    return "";
}

void Ledger::judge(Balance& balance, double defect, const Window& window,
                   const std::string& meaning) {
    const auto text = [&](const char* kind, double limit) {
        return fmt::format("{} = {:.2g} in window {}, limits.{}_{} = {:g}: {}.", balance.column,
                           defect, window.index, balance.column, kind, limit, meaning);
    };
    if (!(defect <= balance.limits.hard))  // true for NaN
        throw PhysicsRefused(text("hard", balance.limits.hard));
    if (defect <= balance.limits.soft || balance.warned) return;
    // Once per run, also of one that was interrupted: the flag is part of a checkpoint.
    balance.warned = true;
    warn_("turbidite: warning: " + text("soft", balance.limits.soft));
}

void Ledger::check_overlap(const Window& window, const Motion& state) const {
    // Of the state: an overlap that the motion alone reports is not judged.
    const double overlap = state.report.max_penetration / settings_.run.diameter;
    if (overlap <= settings_.penetration) return;
    throw PhysicsRefused(fmt::format(
        "overlap of {:.3g} D in window {}, reported by {}; limits.penetration = {:.3g} D. {}",
        overlap, window.index, grains_, settings_.penetration, against_overlap(settings_)));
}

void Ledger::check_divergence(const FluidReport& report) {
    // From [1/s] to [u_c/D].
    const double divergence = report.divergence * settings_.run.diameter / settings_.run.velocity;
    const bool good = divergence <= divergence_limit;  // false for NaN
    divergent_windows_ = good ? 0 : divergent_windows_ + 1;
    if (divergent_windows_ < windows_until_refused) return;
    throw PhysicsRefused(fmt::format(
        "the projection failed in {} consecutive windows: max |div phi| = {:.3g} u_c/D, the limit "
        "is {:.0e}. Use a smaller time.step or fluid.pressure_tolerance.",
        divergent_windows_, divergence, divergence_limit));
}

void Ledger::check_multipliers(const FluidReport& report) {
    stopped_windows_ = report.multipliers_converged ? 0 : stopped_windows_ + 1;
    if (stopped_windows_ < windows_until_refused) return;
    throw PhysicsRefused(
        fmt::format("the multiplier problem stopped at its iteration limit in {} consecutive "
                    "windows, at an rms slip of {:.1e} u_c: {}. Allow more iterations or a larger "
                    "tolerance, or use a smaller time.step or fluid.hydrodynamic_radius.",
                    stopped_windows_, report.multiplier_residual / settings_.run.velocity,
                    text(settings_.solves.multipliers)));
}

}  // namespace turbidite
