// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/step_five.hpp"

#include <algorithm>

#include "coupler/protocol/largest.hpp"

namespace turbidite {
namespace {

void add(FluidReport& total, const FluidReport& share) {
    total.multiplier_iterations =
        std::max(total.multiplier_iterations, share.multiplier_iterations);
    total.multiplier_residual = largest(total.multiplier_residual, share.multiplier_residual);
    total.divergence = largest(total.divergence, share.divergence);
    total.final_divergence = largest(total.final_divergence, share.final_divergence);
    total.momentum_defect = largest(total.momentum_defect, share.momentum_defect);
    total.courant = largest(total.courant, share.courant);
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

Motion receive_motion(Cast& cast) {
    cast.watch.wait_for(cast.grains, Kind::motion);
    return cast.plan.gather(cast.grains.take<Motion>(Kind::motion));
}

void finish_window(const Window& window, const Motion& before, Cast& cast, WindowResult& result) {
    cast.watch.wait_for(*cast.fluid, Kind::kicks);
    result.kicks = merged(cast.fluid->take<Kicks>(Kind::kicks));
    cast.kick_rule.complete(result.kicks.kicks, before, window.step);

    std::vector<Kicks> routed;
    for (auto& kicks : cast.plan.by_owner(result.kicks.kicks))
        routed.push_back({std::move(kicks), result.kicks.report});
    cast.grains.send_each(Kind::kick, routed);
    cast.watch.wait_for(cast.grains, Kind::state);
    result.state = cast.plan.gather(cast.grains.take<Motion>(Kind::state));
}

}  // namespace turbidite
