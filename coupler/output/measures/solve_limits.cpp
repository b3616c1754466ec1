// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/measures/solve_limits.hpp"

#include <fmt/format.h>

#include "coupler/protocol/hello.hpp"
#include "coupler/protocol/scene/splitting.hpp"

namespace turbidite {
namespace {

SolveLimit limit(const Settings& settings, const char* iterations, const char* tolerance) {
    SolveLimit result;
    if (settings.has(iterations)) result.iterations = settings.integer(iterations);
    if (settings.has(tolerance)) result.tolerance = settings.real(tolerance);
    return result;
}

/// No key is known to be a user's program's own.
std::string users_sentence(const RunStatistics& s) {
    const double residual = s.contact_residuals.largest();
    return fmt::format(
        "in {} of {} windows the grains program says that its contact solver has not converged{}. "
        "Allow it more iterations, or use a smaller time.step.",
        s.maxima.unconverged_windows, s.windows_done,
        residual > 0.0 ? fmt::format("; residual up to {:.1e}", residual) : "");
}

std::string contact_sentence(const RunStatistics& s, const SolveLimits& limits) {
    if (limits.users_program) return users_sentence(s);
    return fmt::format(
        "in {} of {} windows the contact solver used up its {} sweeps (contact.iterations) before "
        "contact.tolerance = {:g} was met and no grain sank into a smaller one by a hundredth of "
        "its radius; residual up to {:.1e}{}. Allow more sweeps, or use a smaller time.step.",
        s.maxima.unconverged_windows, s.windows_done, limits.contact.iterations,
        limits.contact.tolerance, s.contact_residuals.largest(),
        s.maxima.contact_violation
            ? fmt::format(", contacts violated by up to {:.2g} u_c", *s.maxima.contact_violation)
            : "");
}

std::string multiplier_sentence(const RunStatistics& s, const SolveLimits& limits) {
    return fmt::format(
        "in {} of {} windows the multiplier problem used up its {} iterations "
        "(fluid.multiplier_iterations); rms slip up to {:.1e} u_c, {:g} required. Allow more "
        "iterations, or a larger fluid.multiplier_tolerance.",
        s.maxima.fluid->unconverged_windows, s.windows_done, limits.multipliers.iterations,
        s.maxima.fluid->slip, limits.slip);
}

std::string once_corrected_sentence(const RunStatistics& s, const SolveLimits& limits) {
    return fmt::format(
        "in {} of {} windows viscosity with rigid grains used up its {} iterations "
        "(fluid.splitting_iterations) or broke down. Allow more iterations, or use a smaller "
        "time.step.",
        s.maxima.fluid->unconverged_splitting_windows, s.windows_done, limits.splitting.iterations);
}

std::string splitting_sentence(const RunStatistics& s, const SolveLimits& limits) {
    if (limits.corrects_once) return once_corrected_sentence(s, limits);
    return fmt::format(
        "in {} of {} windows pressure or viscosity with rigid grains used up its {} iterations "
        "(fluid.splitting_iterations) or broke down; rms divergence up to {:.1e} u_c/D, {:g} "
        "required. Allow "
        "more iterations, a larger fluid.splitting_tolerance, or open pores with a smaller "
        "fluid.hydrodynamic_radius.",
        s.maxima.fluid->unconverged_splitting_windows, s.windows_done, limits.splitting.iterations,
        s.maxima.fluid->remaining_divergence, limits.splitting.tolerance);
}

std::string joint_sentence(const RunStatistics& s, const SolveLimits& limits) {
    return fmt::format(
        "in {} of {} windows contacts and fluid differ by more than coupling.tolerance = {:g} u_c "
        "after coupling.iterations = {} rounds, at most by {:.1e} u_c. Allow more rounds.",
        s.maxima.joint->unconverged_windows, s.windows_done, limits.joint.tolerance,
        limits.joint.iterations, s.maxima.joint->mismatch);
}

}  // namespace

SolveLimits solve_limits(const Settings& settings) {
    SolveLimits limits;
    limits.users_program = settings.text("grains.adapter") == users_program;
    limits.contact = limit(settings, "contact.iterations", "contact.tolerance");
    limits.multipliers =
        limit(settings, "fluid.multiplier_iterations", "fluid.multiplier_tolerance");
    limits.splitting = limit(settings, "fluid.splitting_iterations", "fluid.splitting_tolerance");
    if (settings.has("fluid.splitting")) {
        const Splitting& splitting = splitting_of(settings);
        limits.corrects_once = splitting.rigid_grains && !splitting.iterated;
    }
    limits.joint = limit(settings, "coupling.iterations", "coupling.tolerance");
    if (settings.has("run.slip_tolerance")) limits.slip = settings.real("run.slip_tolerance");
    return limits;
}

std::vector<std::string> unconverged_sentences(const RunStatistics& statistics,
                                               const SolveLimits& limits) {
    const RunMaxima& maxima = statistics.maxima;
    std::vector<std::string> sentences;
    if (maxima.unconverged_windows > 0) sentences.push_back(contact_sentence(statistics, limits));
    if (maxima.fluid && maxima.fluid->unconverged_windows > 0)
        sentences.push_back(multiplier_sentence(statistics, limits));
    if (maxima.fluid && maxima.fluid->unconverged_splitting_windows > 0)
        sentences.push_back(splitting_sentence(statistics, limits));
    if (maxima.joint && maxima.joint->unconverged_windows > 0)
        sentences.push_back(joint_sentence(statistics, limits));
    return sentences;
}

}  // namespace turbidite
