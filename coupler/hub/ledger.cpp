// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/ledger.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

// A projection that leaves more than this [u_c/D] for three windows running has failed.
constexpr double divergence_limit = 1e-4;
constexpr int windows_until_refused = 3;

bool finite(const Vec3& v) {
    return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}

void demand_finite(const Motion& motion, const std::string& when) {
    for (const GrainState& g : motion.grains)
        if (!finite(g.position) || !finite(g.velocity) || !finite(g.angular_velocity))
            throw PhysicsRefused(fmt::format(
                "grain {} is not finite {}: position ({}, {}, {}), velocity ({}, {}, {}). Try a "
                "smaller time.step.",
                g.id, when, g.position[0], g.position[1], g.position[2], g.velocity[0],
                g.velocity[1], g.velocity[2]));
}

void demand_finite(const std::vector<ContactRecord>& contacts, std::int64_t window) {
    for (const ContactRecord& c : contacts)
        if (!finite(c.point) || !finite(c.normal) || !finite(c.branch) || !finite(c.impulse) ||
            !finite(c.rolling_impulse) || !std::isfinite(c.gap))
            throw PhysicsRefused(fmt::format(
                "a contact of grain {} is not finite in window {}: impulse ({}, {}, {}), gap {}. "
                "Try a smaller time.step.",
                c.b, window, c.impulse[0], c.impulse[1], c.impulse[2], c.gap));
}

void demand_finite(const std::vector<Kick>& kicks, std::int64_t window) {
    for (const Kick& k : kicks)
        if (!finite(k.velocity) || !finite(k.angular_velocity) || !finite(k.multiplier_impulse))
            throw PhysicsRefused(fmt::format(
                "the fluid's kick for grain {} is not finite in window {}: velocity ({}, {}, {}). "
                "Try a smaller time.step.",
                k.id, window, k.velocity[0], k.velocity[1], k.velocity[2]));
}

/// What lessens overlaps: springs are as stiff as their own keys say, and sub-steps follow.
std::string against_overlap(const std::string& adapter) {
    if (adapter == "yade-md")
        return "Use a smaller contact.md_overlap, or a larger contact.md_stiffness where it is "
               "given.";
    return "Use a smaller time.step, or more contact.iterations.";
}

}  // namespace

Ledger::Ledger(const Settings& settings, std::size_t population)
    : population_(population),
      diameter_(settings.real("run.diameter")),
      rate_(settings.real("run.velocity_scale") / diameter_),
      penetration_limit_(settings.real("limits.penetration")),
      against_overlap_(against_overlap(settings.text("grains.adapter"))) {}

void Ledger::check_start(const Motion& state) const {
    demand_finite(state, "at the start");
    check_count(state);
}

void Ledger::check(const Window& window, const WindowResult& result) {
    demand_finite(result.motion, fmt::format("after the contacts of window {}", window.index));
    demand_finite(result.kicks.kicks, window.index);
    demand_finite(result.state, fmt::format("after the move of window {}", window.index));
    if (result.state.contacts) demand_finite(*result.state.contacts, window.index);
    removed_ += static_cast<std::size_t>(result.state.report.removed);
    check_count(result.state);
    check_overlap(result.state);
    check_divergence(result.kicks.report);
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
    const double divergence = report.divergence / rate_;
    const bool good = divergence <= divergence_limit;  // false for NaN
    divergent_windows_ = good ? 0 : divergent_windows_ + 1;
    if (divergent_windows_ < windows_until_refused) return;
    throw PhysicsRefused(fmt::format(
        "the projection fails: max |div phi| = {:.3g} u_c/D in {} windows running, {:.0e} allowed. "
        "Use a smaller time.step or fluid.pressure_tolerance.",
        divergence, divergent_windows_, divergence_limit));
}

}  // namespace turbidite
