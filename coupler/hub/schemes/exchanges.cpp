// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/schemes/exchanges.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "coupler/hub/checks/arrival.hpp"
#include "coupler/hub/checks/contact_check.hpp"
#include "coupler/protocol/largest.hpp"

namespace turbidite {
namespace {

/// Waits for one message of every rank and checks the numbers in it.
template <class Record>
std::vector<Record> receive(ParticipantLink& from, const Arrival& arrival, SchemeContext& context) {
    context.watch.wait_for(from, arrival.kind());
    std::vector<Record> shares = from.take<Record>(arrival.kind());
    // Numbers before grains: the checks that follow compute with them.
    for (int rank = 0; rank < from.ranks(); ++rank) arrival.check(rank, shares[rank]);
    return shares;
}

struct Grains {
    Motion motion;
    std::vector<Leaver> leavers;
};

Grains receive_grains(const Arrival& arrival, SchemeContext& context) {
    auto shares = receive<Motion>(context.grains, arrival, context);
    // Then ids, since contacts name grains, and only then one list out of the shares of all ranks.
    std::vector<Leaver> leavers = context.roster.check(shares, arrival);
    check_contacts(shares, context.roster, arrival);
    return {context.plan.gather(std::move(shares)), std::move(leavers)};
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

/// A grain whose motion is given moves in the fluid as in `contact`, which was checked: to the
/// round-off of its way in a window.
void check_given_motions(const std::vector<Kicks>& shares, const Motion& contact, double step,
                         const Arrival& arrival) {
    std::unordered_map<GrainId, const GrainState*> given;
    for (const GrainState& grain : contact.grains)
        if (grain.prescribed) given.emplace(grain.id, &grain);
    if (given.empty()) return;
    const auto apart = [](const Vec3& a, const Vec3& b) {
        return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    };
    for (std::size_t rank = 0; rank < shares.size(); ++rank)
        for (const Kick& kick : shares[rank].kicks) {
            const auto at = given.find(kick.id);
            if (at == given.end()) continue;
            const GrainState& grain = *at->second;
            const double off = apart(kick.velocity, grain.velocity) +
                               grain.radius * apart(kick.angular_velocity, grain.angular_velocity);
            // (|dU| + R |domega|) dt [m] against 1e-9 R.
            if (off * step <= 1e-9 * grain.radius) continue;
            arrival.refuse(
                static_cast<int>(rank),
                fmt::format("kick for grain {}: velocity ({}) and angular velocity ({}) instead of "
                            "the given ({}) and ({})",
                            kick.id, fmt::join(kick.velocity, ", "),
                            fmt::join(kick.angular_velocity, ", "), fmt::join(grain.velocity, ", "),
                            fmt::join(grain.angular_velocity, ", ")),
                "The case gives the motion of this grain: no fluid changes it.");
        }
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

Motion receive_start(SchemeContext& context) {
    // -1: before the first window.
    const Arrival arrival(context.grains, Kind::state, -1);
    Grains received = receive_grains(arrival, context);
    context.motion_rule.check_start(received.leavers,
                                    {received.motion, context.plan.owners(), arrival});
    return std::move(received.motion);
}

Motion receive_motion(const Window& window, const Motion& before, SchemeContext& context) {
    const Arrival arrival(context.grains, Kind::motion, window.index);
    Motion motion = receive_grains(arrival, context).motion;
    context.motion_rule.check_motion(window, before, {motion, context.plan.owners(), arrival});
    return motion;
}

void receive_state(const Window& window, const Motion& before, SchemeContext& context,
                   WindowResult& result) {
    const Arrival arrival(context.grains, Kind::state, window.index);
    Grains received = receive_grains(arrival, context);
    result.state = std::move(received.motion);
    result.motion_defect = context.motion_rule.check_state(
        window, before, result, received.leavers, {result.state, context.plan.owners(), arrival});
}

std::vector<FreeResponse> receive_responses(const Window& window, SchemeContext& context) {
    const Arrival arrival(*context.fluid, Kind::response, window.index);
    const auto shares = receive<std::vector<FreeResponse>>(*context.fluid, arrival, context);
    context.roster.check(shares, arrival);
    std::vector<FreeResponse> responses;
    for (const auto& share : shares) responses.insert(responses.end(), share.begin(), share.end());
    return responses;
}

std::vector<FreeResponse> play_contact_round(const Window& window, const Motion& before,
                                             const std::vector<std::vector<FreeResponse>>& inputs,
                                             SchemeContext& context, WindowResult& result) {
    context.grains.send_each(Kind::contact_input, inputs);
    // Work of earlier rounds; residuals, overlaps and counts are those of the last one.
    const ContactReport so_far = result.motion.report;
    result.motion = receive_motion(window, before, context);
    result.motion.report.iterations += so_far.iterations;
    result.motion.report.wall_seconds += so_far.wall_seconds;
    context.fluid->send_each(Kind::constraint, context.plan.by_place(result.motion));
    ++result.joint->rounds;
    return receive_responses(window, context);
}

void send_accept(SchemeContext& context) {
    for (int rank = 0; rank < context.fluid->ranks(); ++rank)
        context.fluid->send(rank, Kind::accept);
}

void finish_window(const Window& window, const Motion& before, SchemeContext& context,
                   WindowResult& result) {
    const Arrival arrival(*context.fluid, Kind::kicks, window.index);
    const auto shares = receive<Kicks>(*context.fluid, arrival, context);
    context.roster.check(shares, arrival);
    check_given_motions(shares, result.motion, window.step, arrival);
    result.kicks = merged(shares);
    // Forces and torques before the kicks leave: hosts that want forces get them with the
    // velocities.
    context.kick_rule.complete(result.kicks.kicks, before, window.step);

    std::vector<Kicks> routed;
    for (auto& kicks : context.plan.by_owner(result.kicks.kicks))
        // The report is that of the whole fluid, the same for every grains rank.
        routed.push_back({std::move(kicks), result.kicks.report});
    context.grains.send_each(Kind::kick, routed);
    // While the grains move.
    const GrainBalance balance =
        context.kick_rule.balance(result.kicks.kicks, before, result.motion, window.step);
    receive_state(window, before, context, result);
    // Only now are the velocities and impulses of the state known, which output is written from.
    result.grain_balance =
        context.kick_rule.with_state(balance, result.kicks.kicks, result.motion, result.state);
}

}  // namespace turbidite
