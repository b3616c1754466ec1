// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/schemes/exchanges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/largest.hpp"

namespace turbidite {
namespace {

bool finite(const Vec3& v) {
    return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}

std::string when(Kind kind, std::int64_t window) {
    if (window < 0) return "at the start";
    return fmt::format("{} window {}",
                       kind == Kind::motion ? "after the contacts of" : "after the motion of",
                       window);
}

void demand_finite(const Motion& motion, Kind kind, std::int64_t window) {
    for (const GrainState& g : motion.grains)
        if (!finite(g.position) || !finite(g.velocity) || !finite(g.angular_velocity))
            throw PhysicsRefused(fmt::format(
                "grain {} is not finite {}: position ({}, {}, {}), velocity ({}, {}, {}). Try a "
                "smaller time.step.",
                g.id, when(kind, window), g.position[0], g.position[1], g.position[2],
                g.velocity[0], g.velocity[1], g.velocity[2]));
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
        if (!finite(k.velocity) || !finite(k.angular_velocity) || !finite(k.multiplier_impulse) ||
            !finite(k.multiplier_angular_impulse))
            throw PhysicsRefused(fmt::format(
                "the fluid's kick for grain {} is not finite in window {}: velocity ({}, {}, {}). "
                "Try a smaller time.step.",
                k.id, window, k.velocity[0], k.velocity[1], k.velocity[2]));
}

void demand_finite(const std::vector<FreeResponse>& responses, std::int64_t window) {
    const auto all = [](const auto& values) {
        return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
    };
    for (const FreeResponse& r : responses)
        if (!finite(r.velocity) || !finite(r.angular_velocity) || !all(r.inertia) ||
            !std::isfinite(r.mismatch))
            throw PhysicsRefused(
                fmt::format("the fluid's response for grain {} is not finite in "
                            "window {}. Try a smaller time.step.",
                            r.id, window));
}

/// All ranks of a fluid solve together and find the same.
void add(SplittingReport& total, const SplittingReport& share) {
    total.pressure_iterations = std::max(total.pressure_iterations, share.pressure_iterations);
    total.viscous_iterations = std::max(total.viscous_iterations, share.viscous_iterations);
    total.divergence = largest(total.divergence, share.divergence);
    total.viscous_residual = largest(total.viscous_residual, share.viscous_residual);
    total.converged = total.converged && share.converged;
}

void add(FluidReport& total, const FluidReport& share) {
    if (share.splitting) {
        if (!total.splitting) total.splitting.emplace();
        add(*total.splitting, *share.splitting);
    }
    total.multiplier_iterations =
        std::max(total.multiplier_iterations, share.multiplier_iterations);
    total.multiplier_residual = largest(total.multiplier_residual, share.multiplier_residual);
    total.multipliers_converged = total.multipliers_converged && share.multipliers_converged;
    total.divergence = largest(total.divergence, share.divergence);
    total.final_divergence = largest(total.final_divergence, share.final_divergence);
    total.momentum_defect = largest(total.momentum_defect, share.momentum_defect);
    total.courant = largest(total.courant, share.courant);
    total.mean_velocity = share.mean_velocity;  // these are the same on all ranks
    total.probes = share.probes;
    total.wall_seconds = std::max(total.wall_seconds, share.wall_seconds);
}

Kicks merged(const std::vector<Kicks>& shares) {
    Kicks all;
    for (const Kicks& share : shares) {
        all.kicks.insert(all.kicks.end(), share.kicks.begin(), share.kicks.end());
        add(all.report, share.report);
    }
    return all;
}

}  // namespace

Motion receive_grains(Kind kind, std::int64_t window, Cast& cast) {
    cast.watch.wait_for(cast.grains, kind);
    Motion all = cast.plan.gather(cast.grains.take<Motion>(kind));
    demand_finite(all, kind, window);
    if (all.contacts) demand_finite(*all.contacts, window);
    return all;
}

Motion receive_motion(const Window& window, Cast& cast) {
    return receive_grains(Kind::motion, window.index, cast);
}

std::vector<FreeResponse> receive_responses(const Window& window, Cast& cast) {
    cast.watch.wait_for(*cast.fluid, Kind::response);
    std::vector<FreeResponse> responses;
    for (const auto& share : cast.fluid->take<std::vector<FreeResponse>>(Kind::response))
        responses.insert(responses.end(), share.begin(), share.end());
    demand_finite(responses, window.index);
    return responses;
}

void send_accept(Cast& cast) {
    for (int rank = 0; rank < cast.fluid->ranks(); ++rank) cast.fluid->send(rank, Kind::accept, {});
}

void finish_window(const Window& window, const Motion& before, Cast& cast, WindowResult& result) {
    cast.watch.wait_for(*cast.fluid, Kind::kicks);
    result.kicks = merged(cast.fluid->take<Kicks>(Kind::kicks));
    demand_finite(result.kicks.kicks, window.index);
    cast.kick_rule.complete(result.kicks.kicks, before, window.step);

    std::vector<Kicks> routed;
    for (auto& kicks : cast.plan.by_owner(result.kicks.kicks))
        routed.push_back({std::move(kicks), result.kicks.report});
    cast.grains.send_each(Kind::kick, routed);
    result.state = receive_grains(Kind::state, window.index, cast);
}

}  // namespace turbidite
